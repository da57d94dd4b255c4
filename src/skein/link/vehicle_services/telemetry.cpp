// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/telemetry.h"

#include <algorithm>
#include <array>
#include <string>

#include "skein/link/mavlink/payload.h"
#include "skein/link/vehicle_services/message_numbers.h"

namespace skein::vehicle_services {
namespace {

template <auto kMake>
void send_made(const ServedVehicle& vehicle, Outbox& out, Channel channel) {
  out.send(channel, kMake(vehicle));
}

template <auto kMake>
constexpr TelemetryRow row(mavlink::StreamGroup group, float rate_ardupilot,
                           float rate_px4) {
  using Message = decltype(kMake(std::declval<const ServedVehicle&>()));
  return {mavlink::kFacts<Message>.id, group, rate_ardupilot, rate_px4, send_made<kMake>};
}

constexpr std::array<TelemetryRow, kTelemetryRows> make_rows() {
  using enum mavlink::StreamGroup;
  return {
      row<heartbeat>(kAll, 0, 0),  // its rate is fixed
      row<sys_status>(kExtendedStatus, 1, 1),
      row<gps_raw_int>(kExtendedStatus, 2, 2),
      row<mission_current>(kExtendedStatus, 1, 1),
      row<nav_controller_output>(kExtendedStatus, 1, -1),
      row<global_position_int>(kPosition, 5, 5),
      row<local_position_ned>(kPosition, 2, 5),
      row<attitude>(kExtra1, 10, 10),
      row<attitude_quaternion>(kAll, 0, 10),
      row<vfr_hud>(kExtra2, 4, 4),
      row<system_time>(kExtra3, 1, 1),
      row<battery_status>(kExtra3, 0.5, 0.5),
      row<vibration>(kExtra3, 1, 0.5),
      row<ekf_status_report>(kExtra3, 1, -1),
      row<estimator_status>(kExtra3, -1, 1),
      row<wind>(kExtra3, 1, -1),
      row<wind_cov>(kExtra3, -1, 0.5),
      row<rc_channels>(kRcChannels, 1, 1),
      row<servo_output_raw>(kRcChannels, 1, 1),
      row<extended_sys_state>(kAll, 1, 1),
      row<current_mode>(kAll, 0, 0.5),
      row<home_position>(kAll, 0.5, 0.5),
      row<gps_global_origin>(kAll, 0.2F, 0.2F),
  };
}
constexpr auto kRows = make_rows();

float rate_of(const TelemetryRow& row, Make make) {
  return make == Make::kPx4 ? row.rate_px4 : row.rate_ardupilot;
}

// Numbers that differ between vehicles and stay the same between runs.
std::uint64_t serial_number(const ServedVehicle& v, std::uint64_t which) {
  std::uint64_t x =
      v.options.seed + 0x9e3779b97f4a7c15U * (v.options.index * 4ULL + which + 1);
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27) * 0x94d049bb133111ebU;
  return x ^ x >> 31;
}

template <std::size_t N>
void put_bytes(std::array<std::uint8_t, N>& field, std::size_t from,
               std::uint64_t bytes) {
  for (std::size_t i = from; i < std::min(from + 8, N); ++i, bytes >>= 8)
    field[i] = static_cast<std::uint8_t>(bytes);
}

std::size_t selectable_modes(const ServedVehicle& v) {
  return static_cast<std::size_t>(std::ranges::count(
      modes_of(v.options.make, v.options.hovers), true, &ModeRow::selectable));
}

// @param number  of the mode, from 1; 0: all of them.
void send_modes(std::size_t number, const ServedVehicle& v, Outbox& out,
                Channel channel) {
  mavlink::AvailableModes m;
  m.number_modes = static_cast<std::uint8_t>(selectable_modes(v));
  for (const ModeRow& row : modes_of(v.options.make, v.options.hovers)) {
    if (!row.selectable) continue;
    ++m.mode_index;
    if (number != 0 && number != m.mode_index) continue;
    const bool by_sticks =
        row.mode == VehicleMode::kManual || row.mode == VehicleMode::kStabilized;
    m.standard_mode = static_cast<std::uint8_t>(row.standard);
    m.custom_mode = row.number;
    m.properties = by_sticks ? 0 : mavlink::mode_property::kAuto;
    mavlink::set_text(m.mode_name, row.name);
    out.send(channel, m);
  }
}

constexpr auto kAvailableModes = mavlink::kFacts<mavlink::AvailableModes>.id;
constexpr auto kAutopilotVersion = mavlink::kFacts<mavlink::AutopilotVersion>.id;
constexpr auto kProtocolVersion = mavlink::kFacts<mavlink::ProtocolVersion>.id;

}  // namespace

std::span<const TelemetryRow, kTelemetryRows> telemetry_rows() {
  return kRows;
}

std::optional<std::size_t> telemetry_row_of(std::uint32_t id, Make make) {
  const auto found = std::ranges::find(kRows, id, &TelemetryRow::id);
  if (found == kRows.end() || rate_of(*found, make) < 0) return std::nullopt;
  return static_cast<std::size_t>(found - kRows.begin());
}

mavlink::AutopilotVersion autopilot_version(const ServedVehicle& v) {
  using namespace mavlink::capability;
  mavlink::AutopilotVersion m;
  m.capabilities = kMissionFloat | kParamFloat | kMissionInt | kCommandInt |
                   kSetPositionTargetLocal | kSetPositionTargetGlobal | kMavlink2 |
                   kMissionFence | kMissionRally;
  if (!v.options.hovers) m.capabilities |= kSetAttitudeTarget;
  const bool px4 = v.options.make == Make::kPx4;
  m.capabilities |= px4 ? kParamEncodeBytes : kParamEncodeCast;
  // The release whose manners these are: major, minor, patch, and 255 for a release.
  m.flight_sw_version = px4 ? 0x010f04ff : 0x040507ff;
  m.uid = serial_number(v, 0);
  put_bytes(m.uid2, 0, m.uid);
  put_bytes(m.uid2, 8, serial_number(v, 1));
  put_bytes(m.uid2, 16, serial_number(v, 2));
  return m;
}

mavlink::ProtocolVersion protocol_version(const ServedVehicle&) {
  mavlink::ProtocolVersion m;
  m.version = m.max_version = 200;
  m.min_version = 100;
  return m;
}

bool can_send(std::uint32_t id, float detail, const ServedVehicle& v) {
  if (id == kAvailableModes)
    return detail >= 0 && detail <= static_cast<float>(selectable_modes(v));
  return id == kAutopilotVersion || id == kProtocolVersion ||
         telemetry_row_of(id, v.options.make).has_value();
}

bool send_once(std::uint32_t id, float detail, const ServedVehicle& v, Outbox& out,
               Channel channel) {
  if (!can_send(id, detail, v)) return false;
  if (id == kAvailableModes) {
    send_modes(static_cast<std::size_t>(detail), v, out, channel);
  } else if (id == kAutopilotVersion) {
    send_made<autopilot_version>(v, out, channel);
  } else if (id == kProtocolVersion) {
    send_made<protocol_version>(v, out, channel);
  } else {
    kRows[*telemetry_row_of(id, v.options.make)].send(v, out, channel);
  }
  return true;
}

}  // namespace skein::vehicle_services
