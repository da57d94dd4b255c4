// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/link/vehicle_services/message_numbers.h"
#include "skein/link/vehicle_services/telemetry.h"

namespace skein::vehicle_services {
namespace {

constexpr std::uint16_t kNoItems = 65'535;
constexpr std::uint16_t kNoChannel = 65'535;
constexpr std::uint8_t kUnknownSignal = 255;

mavlink::MissionState mission_state(const ServedVehicle& v) {
  using enum mavlink::MissionState;
  if (v.mission.items.empty()) return kNoMission;
  if (v.snapshot.progress.finished) return kComplete;
  if (!v.mission.started) return kNotStarted;
  return v.snapshot.condition.mode == VehicleMode::kMission ? kActive : kPaused;
}

// Where it is flying to, as far as ground stations have said.
const Vec3* destination(const ServedVehicle& v) {
  const auto& items = v.mission.items;
  const std::size_t item = v.snapshot.progress.current;
  switch (v.snapshot.condition.mode) {
    case VehicleMode::kMission:
      return item < items.size() ? &items[item].p_N : nullptr;
    case VehicleMode::kGuided:
      return v.guided.place ? &v.guided.place->p_N : nullptr;
    case VehicleMode::kReturn:
      return &v.snapshot.home_N;
    default:
      return nullptr;
  }
}

std::uint16_t pulse_us(double share) {
  return rounded<std::uint16_t>(1000 + 1000 * std::clamp(share, 0.0, 1.0));
}

}  // namespace

mavlink::MissionCurrent mission_current(const ServedVehicle& v) {
  mavlink::MissionCurrent m;
  m.mission_state = static_cast<std::uint8_t>(mission_state(v));
  m.mission_mode = v.snapshot.condition.mode == VehicleMode::kMission ? 1 : 2;
  if (v.mission.items.empty()) {
    m.total = kNoItems;
    return m;
  }
  m.seq = static_cast<std::uint16_t>(v.present_item() + v.mission.first);
  m.total = static_cast<std::uint16_t>(v.mission.items.size());
  return m;
}

mavlink::NavControllerOutput nav_controller_output(const ServedVehicle& v) {
  const VehicleMotion& motion = v.snapshot.motion;
  const geo::Euler angles = geo::to_euler(motion.q_NB);
  mavlink::NavControllerOutput m;
  m.nav_roll = as_float(geo::degrees(angles.roll));
  m.nav_pitch = as_float(geo::degrees(angles.pitch));
  m.nav_bearing = m.target_bearing = rounded<std::int16_t>(geo::degrees(angles.yaw));
  if (const Vec3* there = destination(v)) {
    const Vec3 way = *there - motion.p_N;
    m.target_bearing =
        rounded<std::int16_t>(geo::degrees(geo::bearing(geo::horizontal(way))));
    m.wp_dist = rounded<std::uint16_t>(geo::horizontal(way).norm());
    m.alt_error = as_float(-way.z());
  }
  return m;
}

mavlink::RcChannels rc_channels(const ServedVehicle& v) {
  mavlink::RcChannels m;
  m.time_boot_ms = boot_ms(v.now.simulated);
  m.rssi = kUnknownSignal;
  const auto pwm_us = [&](std::size_t channel) {
    const std::uint16_t pulse = v.sticks.active ? v.sticks.pwm_us[channel] : 0;
    return pulse == 0 ? kNoChannel : pulse;
  };
  std::size_t count = 0;
  for (std::size_t k = 0; k < Sticks::kCount; ++k)
    if (pwm_us(k) != kNoChannel) count = k + 1;
  m.chancount = static_cast<std::uint8_t>(count);
  m.chan1_raw = pwm_us(0);
  m.chan2_raw = pwm_us(1);
  m.chan3_raw = pwm_us(2);
  m.chan4_raw = pwm_us(3);
  m.chan5_raw = pwm_us(4);
  m.chan6_raw = pwm_us(5);
  m.chan7_raw = pwm_us(6);
  m.chan8_raw = pwm_us(7);
  m.chan9_raw = pwm_us(8);
  m.chan10_raw = pwm_us(9);
  m.chan11_raw = pwm_us(10);
  m.chan12_raw = pwm_us(11);
  m.chan13_raw = pwm_us(12);
  m.chan14_raw = pwm_us(13);
  m.chan15_raw = pwm_us(14);
  m.chan16_raw = pwm_us(15);
  m.chan17_raw = pwm_us(16);
  m.chan18_raw = pwm_us(17);
  return m;
}

mavlink::ServoOutputRaw servo_output_raw(const ServedVehicle& v) {
  mavlink::ServoOutputRaw m;
  m.time_usec = static_cast<std::uint32_t>(boot_us(v.now.simulated));
  const std::uint16_t motor = pulse_us(v.snapshot.throttle);
  if (v.options.hovers) {
    m.servo1_raw = m.servo2_raw = m.servo3_raw = m.servo4_raw = motor;
  } else {
    m.servo3_raw = motor;  // where fixed wings have it; what surfaces do is not reported
  }
  return m;
}

}  // namespace skein::vehicle_services
