// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/outbox.h"
#include "skein/link/vehicle_services/served_vehicle.h"

// What a vehicle says of itself, each message made of the last snapshot. What it does not
// know is marked as the definitions have it.

namespace skein::vehicle_services {

mavlink::Heartbeat heartbeat(const ServedVehicle& vehicle);
mavlink::AutopilotVersion autopilot_version(const ServedVehicle& vehicle);
mavlink::ProtocolVersion protocol_version(const ServedVehicle& vehicle);

mavlink::SystemTime system_time(const ServedVehicle& vehicle);
mavlink::SysStatus sys_status(const ServedVehicle& vehicle);
mavlink::BatteryStatus battery_status(const ServedVehicle& vehicle);
mavlink::ExtendedSysState extended_sys_state(const ServedVehicle& vehicle);
mavlink::EkfStatusReport ekf_status_report(const ServedVehicle& vehicle);
mavlink::EstimatorStatus estimator_status(const ServedVehicle& vehicle);
mavlink::Vibration vibration(const ServedVehicle& vehicle);
mavlink::CurrentMode current_mode(const ServedVehicle& vehicle);

mavlink::GpsRawInt gps_raw_int(const ServedVehicle& vehicle);
mavlink::GlobalPositionInt global_position_int(const ServedVehicle& vehicle);
mavlink::LocalPositionNed local_position_ned(const ServedVehicle& vehicle);
mavlink::Attitude attitude(const ServedVehicle& vehicle);
mavlink::AttitudeQuaternion attitude_quaternion(const ServedVehicle& vehicle);
mavlink::VfrHud vfr_hud(const ServedVehicle& vehicle);
mavlink::Wind wind(const ServedVehicle& vehicle);
mavlink::WindCov wind_cov(const ServedVehicle& vehicle);
mavlink::HomePosition home_position(const ServedVehicle& vehicle);
mavlink::GpsGlobalOrigin gps_global_origin(const ServedVehicle& vehicle);

mavlink::MissionCurrent mission_current(const ServedVehicle& vehicle);
mavlink::NavControllerOutput nav_controller_output(const ServedVehicle& vehicle);
mavlink::RcChannels rc_channels(const ServedVehicle& vehicle);
mavlink::ServoOutputRaw servo_output_raw(const ServedVehicle& vehicle);

/// A message that goes out at a rate.
struct TelemetryRow {
  std::uint32_t id = 0;
  /// Asked for together with others; kAll: only by itself.
  mavlink::StreamGroup group = mavlink::StreamGroup::kAll;
  /// Each second unless a ground station says otherwise; 0: none; below 0: a make does
  /// not have it.
  float rate_ardupilot = 0, rate_px4 = 0;
  void (*send)(const ServedVehicle&, Outbox&, Channel) = nullptr;
};

inline constexpr std::size_t kTelemetryRows = 23;
std::span<const TelemetryRow, kTelemetryRows> telemetry_rows();

/// Place in telemetry_rows() of a message that a make has; none without one.
std::optional<std::size_t> telemetry_row_of(std::uint32_t id, Make make);

/// Sends a message that was asked for once.
/// @param detail  of AVAILABLE_MODES: the mode's number from 1, or 0 for all.
/// @returns  false for one that it does not have.
bool send_once(std::uint32_t id, float detail, const ServedVehicle& vehicle, Outbox& out,
               Channel channel);
/// Whether send_once() would send it.
bool can_send(std::uint32_t id, float detail, const ServedVehicle& vehicle);

}  // namespace skein::vehicle_services
