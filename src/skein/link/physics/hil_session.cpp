// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/hil_session.h"

#include <algorithm>
#include <utility>

namespace skein::physics {
namespace {

constexpr std::uint16_t kSetMessageInterval = 511;  // MAV_CMD
enum class CommandResult : std::uint8_t { kAccepted = 0, kUnsupported = 3 };

constexpr std::uint8_t kGenericType = 0;  // MAV_TYPE
constexpr std::uint8_t kNoAutopilot = 8;  // MAV_AUTOPILOT
constexpr std::uint8_t kActive = 4;       // MAV_STATE
constexpr std::uint8_t kMavlinkVersion = 3;

constexpr float kMinInterval = 1e3F, kMaxInterval = 60e6F;  // [us]

template <class T>
constexpr std::uint32_t kId = mavlink::kFacts<T>.id;

bool is_for(std::uint8_t target, std::uint8_t own) {
  return target == 0 || target == own;
}

}  // namespace

void HilSession::received(std::span<const std::byte> bytes) {
  parser_.read(bytes, [this](const mavlink::Frame& frame) { handle(frame); });
}

void HilSession::handle(const mavlink::Frame& frame) {
  switch (frame.id()) {
    case kId<mavlink::HilActuatorControls>:
      controls_ =
          controls_of(mavlink::unpack<mavlink::HilActuatorControls>(frame.payload()));
      break;
    case kId<mavlink::Heartbeat>:
      autopilot_ = mavlink::unpack<mavlink::Heartbeat>(frame.payload()).autopilot;
      break;
    case kId<mavlink::CommandLong>:
      if (is_for(frame.target_system(), writer_.system()) &&
          is_for(frame.target_component(), writer_.component()))
        obey(mavlink::unpack<mavlink::CommandLong>(frame.payload()), frame);
      break;
    default:
      break;
  }
}

void HilSession::obey(const mavlink::CommandLong& command, const mavlink::Frame& frame) {
  mavlink::CommandAck ack;
  ack.command = command.command;
  ack.target_system = frame.system();
  ack.target_component = frame.component();
  const bool known =
      command.command == kSetMessageInterval &&
      command.param1 == static_cast<float>(kId<mavlink::HilStateQuaternion>);
  ack.result = static_cast<std::uint8_t>(known ? CommandResult::kAccepted
                                               : CommandResult::kUnsupported);
  if (known) {
    // 0 is the usual rate, which is none; negative: off.
    truth_interval_.reset();
    if (command.param2 > 0)
      truth_interval_ = Time::from_seconds(
          1e-6 * double{std::clamp(command.param2, kMinInterval, kMaxInterval)});
    truth_due_.reset();
  }
  write(ack);
}

void HilSession::send(const HilTruth& truth) {
  if (!truth_interval_ || (truth_due_ && truth.time < *truth_due_)) return;
  write(message_of(truth));
  // Kept up on average where steps and interval do not fit; what was missed is not made
  // up.
  const Time next = truth_due_.value_or(truth.time) + *truth_interval_;
  truth_due_ = next > truth.time ? next : truth.time + *truth_interval_;
}

void HilSession::send_heartbeat() {
  mavlink::Heartbeat heartbeat;
  heartbeat.type = kGenericType;
  heartbeat.autopilot = kNoAutopilot;
  heartbeat.system_status = kActive;
  heartbeat.mavlink_version = kMavlinkVersion;
  write(heartbeat);
}

std::optional<HilControls> HilSession::take_controls() {
  return std::exchange(controls_, std::nullopt);
}

}  // namespace skein::physics
