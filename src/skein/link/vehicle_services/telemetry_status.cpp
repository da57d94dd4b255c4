// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "skein/link/mavlink/flight_modes.h"
#include "skein/link/vehicle_services/message_numbers.h"
#include "skein/link/vehicle_services/telemetry.h"

namespace skein::vehicle_services {
namespace {

constexpr std::uint16_t kNoVoltage = 65'535;
constexpr double kMaxMillivolts = 65'534;  // of one cell's field

// Of which a vehicle's voltage takes as many as it needs.
template <std::size_t N>
void spread_voltage(double voltage, std::array<std::uint16_t, N>& cells_mV) {
  cells_mV.fill(kNoVoltage);
  double left_mV = voltage * 1000;
  for (std::uint16_t& cell : cells_mV) {
    if (!(left_mV > 0)) return;
    cell = rounded<std::uint16_t>(std::min(left_mV, kMaxMillivolts));
    left_mV -= kMaxMillivolts;
  }
}

std::int8_t percent_left(const VehicleCondition& condition) {
  return rounded<std::int8_t>(std::clamp(condition.charge, 0.0, 1.0) * 100);
}

std::int16_t centiamperes(const VehicleCondition& condition) {
  return condition.current > 0 ? rounded<std::int16_t>(condition.current * 100)
                               : std::int16_t{-1};
}

mavlink::SystemState state_of(const ServedVehicle& v) {
  using enum mavlink::SystemState;
  if (!v.known) return kBoot;
  const VehicleCondition& condition = v.snapshot.condition;
  if (condition.emergency) return kEmergency;
  if (!condition.armed && condition.on_ground) return kStandby;
  return condition.charge < v.options.critical_charge ? kCritical : kActive;
}

mavlink::LandedState landed_state(const ServedVehicle& v) {
  using enum mavlink::LandedState;
  if (v.snapshot.condition.on_ground) return kOnGround;
  switch (v.snapshot.condition.mode) {
    case VehicleMode::kTakeOff:
      return kTakeOff;
    case VehicleMode::kLand:
      return kLanding;
    default:
      return kInAir;
  }
}

std::uint16_t estimator_flags(const ServedVehicle& v) {
  using namespace mavlink::estimator_bit;
  const std::uint16_t always = kAttitude | kVerticalVelocity | kAltitude;
  return static_cast<std::uint16_t>(
      v.snapshot.condition.position
          ? always | kHorizontalVelocity | kRelativePosition | kAbsolutePosition |
                kPredictsRelativePosition | kPredictsAbsolutePosition
          : always | kConstantPosition);
}

}  // namespace

mavlink::Heartbeat heartbeat(const ServedVehicle& v) {
  mavlink::Heartbeat m;
  m.type = static_cast<std::uint8_t>(v.options.hovers ? mavlink::VehicleType::kQuadrotor
                                                      : mavlink::VehicleType::kFixedWing);
  m.autopilot = v.options.make == Make::kPx4 ? mavlink::kAutopilotPx4
                                             : mavlink::kAutopilotArduPilot;
  m.base_mode = mode_flags_of(v.snapshot.condition.mode);
  if (v.snapshot.condition.armed) m.base_mode |= mavlink::kModeArmed;
  m.custom_mode = v.shown_mode().number;
  m.system_status = static_cast<std::uint8_t>(state_of(v));
  m.mavlink_version = 3;
  return m;
}

mavlink::SystemTime system_time(const ServedVehicle& v) {
  mavlink::SystemTime m;
  m.time_unix_usec = static_cast<std::uint64_t>(
      std::max<std::int64_t>(v.options.start_unix_us + v.now.simulated.ns() / 1000, 0));
  m.time_boot_ms = boot_ms(v.now.simulated);
  return m;
}

mavlink::SysStatus sys_status(const ServedVehicle& v) {
  using namespace mavlink::sensor_bit;
  const VehicleCondition& condition = v.snapshot.condition;
  std::uint32_t present = kGyro | kAccelerometer | kMagnetometer | kAbsolutePressure |
                          kGps | kRateControl | kAttitudeControl | kYawControl |
                          kAltitudeControl | kPositionControl | kMotorOutputs | kAhrs |
                          kBattery | kPreArmCheck | kGeofence;
  if (!v.options.hovers) present |= kDifferentialPressure;
  std::uint32_t enabled = present;
  if (!v.fence.enabled) enabled &= ~kGeofence;
  if (v.sticks.active) {
    present |= kRcReceiver;
    enabled |= kRcReceiver;
  }
  std::uint32_t healthy = present;
  if (!condition.position) healthy &= ~(kGps | kPositionControl | kAhrs);
  if (condition.charge < v.options.critical_charge) healthy &= ~kBattery;
  if (!condition.ready || !v.snapshot.not_ready.empty()) healthy &= ~kPreArmCheck;
  mavlink::SysStatus m;
  m.onboard_control_sensors_present = present;
  m.onboard_control_sensors_enabled = enabled;
  m.onboard_control_sensors_health = healthy;
  m.voltage_battery = condition.voltage > 0
                          ? rounded_below_max<std::uint16_t>(condition.voltage * 1000)
                          : kNoVoltage;
  m.current_battery = centiamperes(condition);
  m.battery_remaining = percent_left(condition);
  return m;
}

mavlink::BatteryStatus battery_status(const ServedVehicle& v) {
  const VehicleCondition& condition = v.snapshot.condition;
  mavlink::BatteryStatus m;
  m.battery_function = 1;  // all that it has
  m.temperature = 32'767;  // not measured
  spread_voltage(condition.voltage, m.voltages);
  m.current_battery = centiamperes(condition);
  m.current_consumed = m.energy_consumed = -1;  // not known
  m.battery_remaining = percent_left(condition);
  using enum mavlink::ChargeState;
  m.charge_state =
      static_cast<std::uint8_t>(condition.charge < v.options.critical_charge ? kCritical
                                : condition.charge < v.options.low_charge    ? kLow
                                                                             : kOk);
  return m;
}

mavlink::ExtendedSysState extended_sys_state(const ServedVehicle& v) {
  mavlink::ExtendedSysState m;
  m.landed_state = static_cast<std::uint8_t>(landed_state(v));
  return m;
}

mavlink::EkfStatusReport ekf_status_report(const ServedVehicle& v) {
  mavlink::EkfStatusReport m;
  m.flags = estimator_flags(v);
  return m;
}

mavlink::EstimatorStatus estimator_status(const ServedVehicle& v) {
  mavlink::EstimatorStatus m;
  m.time_usec = boot_us(v.snapshot.motion.time);
  m.flags = estimator_flags(v);
  m.pos_horiz_accuracy = as_float(v.snapshot.motion.position_sd);
  m.pos_vert_accuracy = as_float(v.snapshot.motion.altitude_sd);
  return m;
}

mavlink::Vibration vibration(const ServedVehicle& v) {
  mavlink::Vibration m;  // there is none
  m.time_usec = boot_us(v.now.simulated);
  return m;
}

mavlink::CurrentMode current_mode(const ServedVehicle& v) {
  const ModeRow& row = v.shown_mode();
  mavlink::CurrentMode m;
  m.standard_mode = static_cast<std::uint8_t>(row.standard);
  m.custom_mode = row.number;
  m.intended_custom_mode = row.number;
  return m;
}

}  // namespace skein::vehicle_services
