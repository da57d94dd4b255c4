// SPDX-License-Identifier: Apache-2.0
#include "skein/link/flight_model/x_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

namespace skein::flight_model {
namespace {

constexpr std::size_t kHead = 5;           // four letters, and a byte that differs
constexpr std::size_t kPositionSize = 69;  // head, 3 doubles, 10 floats
constexpr std::size_t kRow = 8;            // number and value of a dataref
constexpr std::size_t kRequestName = 400;  // bytes for the name of a dataref in RREF
constexpr std::size_t kSettingName = 500;  // the same in DREF

enum Dataref : std::size_t {
  kFlightTime,
  kPaused,
  kOnGround,
  kWindX,
  kWindY,
  kWindZ,
  kFuelWeight,
  kMaxFuel,
  kDatarefs
};
constexpr std::array<std::string_view, kDatarefs> kNames = {
    "sim/time/total_flight_time_sec",
    "sim/time/paused",
    "sim/flightmodel/failures/onground_any",
    "sim/weather/wind_now_x_msc",
    "sim/weather/wind_now_y_msc",
    "sim/weather/wind_now_z_msc",
    "sim/flightmodel/weight/m_fuel_total",
    "sim/aircraft/weight/acf_m_fuel_tot",
};

template <class T>
void append(std::string& text, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  text.append(bytes, sizeof value);
}

template <class T>
T number_from(std::span<const std::byte> bytes, std::size_t place) {
  T value;  // both sides are little-endian, see mavlink/payload.h
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

std::string padded(std::string_view name, std::size_t size, char with) {
  std::string text(name);
  text += '\0';
  text.resize(size, with);
  return text;
}

std::string request(std::size_t number) {
  std::string text("RREF\0", kHead);
  append(text, std::int32_t{kXPlaneRate});
  append(text, static_cast<std::int32_t>(number));
  return text + padded(kNames[number], kRequestName, '\0');
}

std::string setting(std::string_view dataref, double value) {
  std::string text("DREF\0", kHead);
  append(text, static_cast<float>(value));
  return text + padded(dataref, kSettingName, ' ');
}

bool begins_with(std::span<const std::byte> datagram, const char* letters) {
  return datagram.size() >= kHead && std::memcmp(datagram.data(), letters, 4) == 0;
}

// Degrees of any turn to radians; what is not finite stays so.
double angle(float degrees) {
  return geo::radians(static_cast<double>(degrees));
}

}  // namespace

std::vector<std::string> x_plane_requests() {
  std::vector<std::string> all;
  const std::string rate = std::to_string(kXPlaneRate);
  all.push_back(std::string("RPOS\0", kHead) + rate + '\0');
  for (std::size_t k = 0; k < kNames.size(); ++k) all.push_back(request(k));
  return all;
}

std::vector<std::string> x_plane_controls(const FlightControls& controls,
                                          bool takes_over) {
  std::vector<std::string> all;
  if (takes_over) {
    all.push_back(setting("sim/operation/override/override_joystick", 1));
    all.push_back(setting("sim/operation/override/override_toe_brakes", 1));
  }
  all.push_back(setting("sim/joystick/yoke_roll_ratio", controls.aileron));
  all.push_back(setting("sim/joystick/yoke_pitch_ratio", controls.elevator));
  all.push_back(setting("sim/joystick/yoke_heading_ratio", controls.rudder));
  all.push_back(
      setting("sim/cockpit2/engine/actuators/throttle_ratio_all", controls.throttle));
  all.push_back(setting("sim/cockpit2/controls/left_brake_ratio", controls.brake));
  all.push_back(setting("sim/cockpit2/controls/right_brake_ratio", controls.brake));
  return all;
}

void XPlaneReader::read_datarefs(std::span<const std::byte> rows) {
  values_.resize(kDatarefs);
  for (std::size_t at = 0; at < rows.size(); at += kRow) {
    const auto number = number_from<std::int32_t>(rows, at);
    const auto value = number_from<float>(rows, at + 4);
    if (number >= 0 && static_cast<std::size_t>(number) < kDatarefs &&
        std::isfinite(value))
      values_[static_cast<std::size_t>(number)] = value;
  }
}

std::optional<FlightState> XPlaneReader::read(std::span<const std::byte> datagram) {
  if (begins_with(datagram, "RREF") && (datagram.size() - kHead) % kRow == 0) {
    read_datarefs(datagram.subspan(kHead));
    return std::nullopt;
  }
  if (!begins_with(datagram, "RPOS") || datagram.size() != kPositionSize) {
    ++counts_.passed_over;
    return std::nullopt;
  }
  if (values_.empty() || !values_[kFlightTime] || !values_[kOnGround] ||
      values_[kPaused].value_or(0) != 0)
    return std::nullopt;
  const auto large = [&](std::size_t k) {
    return number_from<double>(datagram, kHead + 8 * k);
  };
  const auto small = [&](std::size_t k) {
    return number_from<float>(datagram, kHead + 24 + 4 * k);
  };
  const auto value = [&](Dataref k) {
    return static_cast<double>(values_[k].value_or(0.0F));
  };
  FlightState state;
  state.time = value(kFlightTime);
  state.place = {large(1), large(0), large(2)};
  state.q_NB = geo::from_euler({angle(small(3)), angle(small(1)), angle(small(2))});
  // Its axes point east, up and south.
  state.v_N = {-static_cast<double>(small(6)), static_cast<double>(small(4)),
               -static_cast<double>(small(5))};
  state.w_NB_B = Vec3(small(7), small(8), small(9));
  state.wind_N = {-value(kWindZ), value(kWindX), -value(kWindY)};
  const double tank = value(kMaxFuel);
  state.fuel = tank > 0 ? std::clamp(value(kFuelWeight) / tank, 0.0, 1.0) : 1;
  state.on_ground = value(kOnGround) != 0;
  if (!check(state)) {
    ++counts_.passed_over;
    return std::nullopt;
  }
  ++counts_.states;
  return state;
}

}  // namespace skein::flight_model
