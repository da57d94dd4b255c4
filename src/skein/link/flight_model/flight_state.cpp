// SPDX-License-Identifier: Apache-2.0
#include "skein/link/flight_model/flight_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein::flight_model {
namespace {

constexpr double kMaxTime = 1e7;                            // of a program's clock [s]
constexpr double kMinAltitude = -1000, kMaxAltitude = 1e5;  // [m]
constexpr double kMaxSpeed = 3000;                          // [m/s]
constexpr double kMaxRate = 100;                            // of turn [rad/s]
constexpr double kMaxWind = 300;                            // [m/s]

Error out_of_range(const char* what) {
  return {ErrorCode::kBadInput, "", fmt::format("its {} cannot be.", what), ""};
}

// False for what is not finite, too.
bool within(double value, double min, double max) {
  return value >= min && value <= max;
}
bool within(const Vec3& v, double max) {
  return within(v.x(), -max, max) && within(v.y(), -max, max) && within(v.z(), -max, max);
}

double bounded(double value, double min, double max) {
  return std::isfinite(value) ? std::clamp(value, min, max) : 0;
}

}  // namespace

Result<void> check(const FlightState& state) {
  if (!within(state.time, 0, kMaxTime)) return out_of_range("time");
  if (!within(state.place.latitude_deg, -90, 90) ||
      !within(state.place.longitude_deg, -180, 180))
    return out_of_range("place");
  if (!within(state.place.height_m, kMinAltitude, kMaxAltitude))
    return out_of_range("altitude");
  if (!within(state.v_N, kMaxSpeed)) return out_of_range("velocity");
  if (!within(state.q_NB.norm(), 0.99, 1.01)) return out_of_range("attitude");
  if (!within(state.w_NB_B, kMaxRate)) return out_of_range("rate of turn");
  if (!within(state.wind_N, kMaxWind)) return out_of_range("wind");
  if (!within(state.fuel, 0, 1)) return out_of_range("fuel");
  return {};
}

FlightControls controls_of(const Actuators& actuators) {
  FlightControls controls;
  controls.aileron = bounded(actuators[channel::kAileron], -1, 1);
  // Those of the plant pitch down and yaw left.
  controls.elevator = -bounded(actuators[channel::kElevator], -1, 1);
  controls.rudder = -bounded(actuators[channel::kRudder], -1, 1);
  controls.throttle = bounded(actuators[channel::kThrottle], 0, 1);
  controls.brake = bounded(actuators[channel::kBrake], 0, 1);
  return controls;
}

}  // namespace skein::flight_model
