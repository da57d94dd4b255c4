// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/pilot_override.h"

#include <algorithm>
#include <cmath>

#include "skein/link/vehicle_services/message_numbers.h"

namespace skein::vehicle_services {
namespace {

const Time kSilence = Time::from_seconds(3);
constexpr double kTakesOver = 0.3;  // of a stick's way

constexpr std::uint16_t kReleased = 0;
constexpr std::uint16_t kUnchanged = 65'535;
constexpr std::uint16_t kReleasedAbove8 = 65'534;  // of channels 9 and up
constexpr std::int16_t kNoAxis = 32'767;

double centred_share(std::uint16_t pulse_us) {
  return std::clamp((pulse_us - 1500) / 500.0, -1.0, 1.0);
}
double throttle_share(std::uint16_t pulse_us) {
  return std::clamp((pulse_us - 1000) / 1000.0, 0.0, 1.0);
}

std::array<std::uint16_t, Sticks::kCount> pulses_of(
    const mavlink::RcChannelsOverride& m) {
  return {m.chan1_raw,  m.chan2_raw,  m.chan3_raw,  m.chan4_raw,  m.chan5_raw,
          m.chan6_raw,  m.chan7_raw,  m.chan8_raw,  m.chan9_raw,  m.chan10_raw,
          m.chan11_raw, m.chan12_raw, m.chan13_raw, m.chan14_raw, m.chan15_raw,
          m.chan16_raw, m.chan17_raw, m.chan18_raw};
}

// An axis of a joystick; a missing one is in the middle.
double axis(std::int16_t value) {
  return value == kNoAxis ? 0 : std::clamp(value / 1000.0, -1.0, 1.0);
}

}  // namespace

void PilotOverride::handle(const mavlink::RcChannelsOverride& channels,
                           ServedVehicle& vehicle) {
  const auto pulses = pulses_of(channels);
  const auto idle = [](std::uint16_t p) { return p == kReleased || p == kUnchanged; };
  if (std::all_of(pulses.begin(), pulses.begin() + 4, idle)) return release(vehicle);
  auto& held = vehicle.sticks.pwm_us;
  for (std::size_t k = 0; k < pulses.size(); ++k) {
    const bool above_8 = k >= 8;
    if (pulses[k] == kUnchanged || (above_8 && pulses[k] == 0)) continue;
    held[k] = above_8 && pulses[k] == kReleasedAbove8 ? std::uint16_t{0} : pulses[k];
  }
  PilotInput sticks;
  if (held[0] != 0) sticks.roll = centred_share(held[0]);
  if (held[1] != 0) sticks.pitch = centred_share(held[1]);
  sticks.throttle = held[2] != 0 ? throttle_share(held[2]) : vehicle.snapshot.throttle;
  if (held[3] != 0) sticks.yaw = centred_share(held[3]);
  take(sticks, vehicle);
}

void PilotOverride::handle(const mavlink::ManualControl& joystick,
                           ServedVehicle& vehicle) {
  PilotInput sticks;
  sticks.pitch = -axis(joystick.x);  // forward is nose down
  sticks.roll = axis(joystick.y);
  sticks.throttle = joystick.z == kNoAxis ? vehicle.snapshot.throttle
                                          : std::clamp(joystick.z / 1000.0, 0.0, 1.0);
  sticks.yaw = axis(joystick.r);
  const auto pulse_us = [](double share) {
    return rounded<std::uint16_t>(1500 + 500 * share);
  };
  vehicle.sticks.pwm_us = {pulse_us(sticks.roll), pulse_us(sticks.pitch),
                           pulse_us(2 * sticks.throttle - 1), pulse_us(sticks.yaw)};
  take(sticks, vehicle);
}

void PilotOverride::take(const PilotInput& sticks, ServedVehicle& vehicle) {
  vehicle.sticks.active = true;
  heard_ = vehicle.now.wall;
  last_ = sticks;
  const double moved =
      std::max({std::abs(sticks.roll), std::abs(sticks.pitch), std::abs(sticks.yaw)});
  const VehicleMode mode = vehicle.mode();
  const bool by_mode = mode == VehicleMode::kManual || mode == VehicleMode::kStabilized;
  // The vehicle has left the mode in which sticks count.
  if (flies_ && by_mode_ && !by_mode) give_up(vehicle);
  if (!flies_) {
    if (moved < kTakesOver) centred_ = true;
    if (!by_mode && (!centred_ || moved < kTakesOver)) return;
    flies_ = true;
    by_mode_ = by_mode;
    centred_ = false;
    if (!by_mode) vehicle.say(mavlink::Severity::kNotice, "Safety pilot flies");
  }
  last_.time = vehicle.now.simulated;
  last_.takes_over = true;
  last_.mode =
      mode == VehicleMode::kManual ? FlightMode::kManual : FlightMode::kStabilized;
  vehicle.request(PilotRequest{last_});
}

void PilotOverride::release(ServedVehicle& vehicle) {
  vehicle.sticks = {};
  if (!flies_) return;
  flies_ = false;
  last_.time = vehicle.now.simulated;
  last_.takes_over = false;
  vehicle.request(PilotRequest{last_});
  vehicle.say(mavlink::Severity::kNotice, "Safety pilot hands back");
}

void PilotOverride::step(ServedVehicle& vehicle) {
  if (vehicle.sticks.active && vehicle.now.wall - heard_ >= kSilence) release(vehicle);
}

void PilotOverride::give_up(ServedVehicle& vehicle) {
  if (!flies_) return;
  const Sticks sticks = vehicle.sticks;  // they go on, and lie idle
  release(vehicle);
  vehicle.sticks = sticks;
}

}  // namespace skein::vehicle_services
