// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/channel_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "skein/data/vehicle/control.h"

namespace skein::physics {
namespace {

constexpr std::size_t kWingChannels = channel::kBrake + 1;

struct WingChannel {
  std::string_view word;
  std::size_t channel;
  double sign;  // 0: a motor
};
constexpr WingChannel kWing[] = {{"aileron", channel::kAileron, 1},
                                 {"elevator", channel::kElevator, -1},
                                 {"rudder", channel::kRudder, -1},
                                 {"throttle", channel::kThrottle, 0},
                                 {"brake", channel::kBrake, 0}};

Error no_actuators() {
  return {ErrorCode::kBadInput, "plant",
          "holds its attitude by itself: it has no actuators that an outside autopilot "
          "could move.",
          "Choose fixed-wing or multirotor."};
}

// The rotor in a quarter, seen from above; none or several: nothing.
std::optional<std::size_t> rotor_at(const MultirotorAirframe& airframe, bool front,
                                    bool right) {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < airframe.rotors.size(); ++k) {
    const Vec2& at = airframe.rotors[k].position;
    if (at.x() == 0 || at.y() == 0 || (at.x() > 0) != front || (at.y() > 0) != right)
      continue;
    if (found) return std::nullopt;
    found = k;
  }
  return found;
}

Result<std::vector<std::string>> quad_words(const MultirotorAirframe& airframe) {
  struct Motor {
    bool front, right;
    double spin;
  };
  constexpr Motor kMotors[] = {
      {true, true, 1}, {false, false, 1}, {true, false, -1}, {false, true, -1}};
  std::vector<std::string> words;
  for (const Motor& motor : kMotors) {
    const auto rotor = rotor_at(airframe, motor.front, motor.right);
    if (!rotor || airframe.rotors.size() != std::size(kMotors) ||
        airframe.rotors[*rotor].spin * motor.spin <= 0)
      return Error{ErrorCode::kBadInput, "vehicle.physics.outputs",
                   "is needed: the rotors of the plant are no X of four, of which front "
                   "right and rear left yaw it clockwise.",
                   "Say which rotor each output of the autopilot drives."};
    words.push_back(fmt::format("rotor-{}", *rotor));
  }
  return words;
}

}  // namespace

Result<ChannelMap> ChannelMap::usual(Make make, const Airframe& airframe) {
  if (const auto* rotors = std::get_if<MultirotorAirframe>(&airframe)) {
    const auto words = quad_words(*rotors);
    if (!words) return words.error();
    return of_words(words.value(), airframe);
  }
  if (make == Make::kArduPilot)
    return of_words({"aileron", "elevator", "throttle", "rudder"}, airframe);
  return of_words({"aileron", "elevator", "rudder", "throttle"}, airframe);
}

Result<ChannelMap> ChannelMap::of_words(const std::vector<std::string>& words,
                                        const Airframe& airframe) {
  if (std::holds_alternative<SelfStabilised>(airframe)) return no_actuators();
  const auto* rotors = std::get_if<MultirotorAirframe>(&airframe);
  const auto use_of = [&](std::string_view word) -> std::optional<Use> {
    if (word == "none") return Use{};
    const bool reversed = word.starts_with('-');
    if (reversed) word.remove_prefix(1);
    if (rotors) {
      for (std::size_t k = 0; k < rotors->rotors.size(); ++k)
        if (!reversed && word == fmt::format("rotor-{}", k))
          return Use{Kind::kMotor, k, 1};
      return std::nullopt;
    }
    for (const WingChannel& each : kWing)
      if (word == each.word && !(reversed && each.sign == 0))
        return Use{each.sign == 0 ? Kind::kMotor : Kind::kSurface, each.channel,
                   each.sign == 0 ? 1 : (reversed ? -1 : 1) * each.sign};
    return std::nullopt;
  };
  ChannelMap map;
  map.channels_ = rotors ? rotors->rotors.size() : kWingChannels;
  for (const std::string& word : words) {
    const auto use = use_of(word);
    if (!use)
      return Error{
          ErrorCode::kBadInput, "vehicle.physics.outputs",
          fmt::format("\"{}\" is nothing that an output can move here.", word),
          rotors ? "There are rotor-0, rotor-1... and none."
                 : "There are aileron, elevator, rudder, throttle, brake and none; a "
                   "\"-\" before a surface turns it round."};
    if (use->kind != Kind::kNone &&
        std::any_of(map.uses_.begin(), map.uses_.end(), [&](const Use& other) {
          return other.kind != Kind::kNone && other.channel == use->channel;
        }))
      return Error{ErrorCode::kBadInput, "vehicle.physics.outputs",
                   fmt::format("\"{}\" is moved by two outputs.", word), ""};
    map.uses_.push_back(*use);
  }
  return map;
}

void ChannelMap::apply(std::span<const double> outputs, std::span<float> channels) const {
  for (std::size_t k = 0; k < std::min(uses_.size(), outputs.size()); ++k) {
    const Use& use = uses_[k];
    if (use.kind == Kind::kNone || use.channel >= channels.size()) continue;
    const double value = std::isfinite(outputs[k]) ? outputs[k] : 0;
    channels[use.channel] = static_cast<float>(
        use.sign * std::clamp(value, use.kind == Kind::kMotor ? 0.0 : -1.0, 1.0));
  }
}

}  // namespace skein::physics
