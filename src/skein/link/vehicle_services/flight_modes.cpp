// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/flight_modes.h"

#include <fmt/format.h>

#include <utility>

namespace skein::vehicle_services {
namespace {

using mavlink::CommandResult;

const Time kTakeOffWaits = Time::from_seconds(30);
const Time kStreamEnds = Time::from_seconds(1);  // of setpoints
constexpr double kMinClimb = 0.5;                // of a take-off [m]

Answer no_room() {
  return {CommandResult::kTemporarilyRejected, "The simulation is busy"};
}

bool needs_position(VehicleMode mode) {
  switch (mode) {
    case VehicleMode::kHold:
    case VehicleMode::kGuided:
    case VehicleMode::kMission:
    case VehicleMode::kTakeOff:
    case VehicleMode::kReturn:
      return true;
    default:
      return false;
  }
}

// Why a mode cannot be flown now, for people; empty: it can.
std::string why_not(const ServedVehicle& vehicle, const ModeRow& row) {
  if (!vehicle.known) return "the simulation has not begun";
  if (needs_position(row.mode) && !vehicle.snapshot.condition.position)
    return "its position is not known";
  if (row.mode == VehicleMode::kMission && vehicle.mission.items.empty())
    return "no mission is stored";
  const auto& setpoint = vehicle.guided.last_setpoint;
  if (row.number == kPx4Offboard && vehicle.options.make == Make::kPx4 &&
      (!setpoint || vehicle.now.wall - *setpoint > kStreamEnds))
    return "no setpoints come in";
  return {};
}

const ModeRow& own_row(const ServedVehicle& vehicle, VehicleMode mode) {
  return row_of(mode, vehicle.options.make, vehicle.options.hovers);
}

// The request that a mode is asked for by.
VehicleRequest mode_request(const ServedVehicle& vehicle, VehicleMode mode) {
  if (mode == VehicleMode::kMission && vehicle.mission.selected)
    return MissionStart{*vehicle.mission.selected};
  return ModeRequest{mode};
}

// Asks for something that changes the mode; whoever flew it before does no more.
Answer request_mode(ServedVehicle& vehicle, PilotOverride& pilot, VehicleRequest request,
                    const ModeRow& row) {
  if (!vehicle.requests.has_room(2)) return no_room();
  if (row.mode != VehicleMode::kManual && row.mode != VehicleMode::kStabilized)
    pilot.give_up(vehicle);
  vehicle.take_off_when_armed.reset();
  vehicle.forget_guided();
  if (const auto* start = std::get_if<MissionStart>(&request))
    vehicle.mission.expected.expect(start->item, vehicle.now.wall);
  vehicle.request_mode(std::move(request), row);
  return {};
}

}  // namespace

Answer arm(ServedVehicle& vehicle, bool arm, bool force) {
  const bool px4 = vehicle.options.make == Make::kPx4;
  const auto refused = px4 ? CommandResult::kTemporarilyRejected : CommandResult::kFailed;
  if (!vehicle.known) return {refused, "Arm: the simulation has not begun"};
  if (arm == vehicle.armed()) return {};
  if (!arm && !force && vehicle.flying()) return {refused, "Disarm: it is in flight"};
  force = force || !vehicle.settings.arming_checks;
  if (arm && !force && !vehicle.snapshot.not_ready.empty())
    return {refused, "Arm: " + vehicle.snapshot.not_ready};
  if (arm && !force && !vehicle.snapshot.condition.ready)
    return {refused, "Arm: it is not ready"};
  if (!vehicle.request(ArmRequest{arm, force})) return no_room();
  vehicle.armed_expected.expect(arm, vehicle.now.wall);
  return {};
}

Answer set_mode(ServedVehicle& vehicle, PilotOverride& pilot, std::uint32_t number) {
  const ModeRow* row = find_mode(number, vehicle.options.make, vehicle.options.hovers);
  if (!row || !row->selectable)
    return {CommandResult::kDenied,
            "Mode: there is none with number " + std::to_string(number)};
  return set_mode(vehicle, pilot, *row);
}

Answer set_mode(ServedVehicle& vehicle, PilotOverride& pilot, const ModeRow& row) {
  if (const std::string why = why_not(vehicle, row); !why.empty())
    return {CommandResult::kTemporarilyRejected,
            "Mode " + std::string(row.name) + ": " + why};
  if (row.mode == VehicleMode::kTakeOff) {
    if (vehicle.flying())
      return {CommandResult::kTemporarilyRejected, "Take-off: it flies already"};
    const TakeOffRequest request{vehicle.home_msl() + vehicle.settings.take_off_height,
                                 std::nullopt};
    if (vehicle.armed()) return request_mode(vehicle, pilot, request, row);
    const Answer answer = request_mode(vehicle, pilot, ModeRequest{row.mode}, row);
    if (answer.result != CommandResult::kAccepted) return answer;
    vehicle.take_off_when_armed = request;
    vehicle.take_off_waits_until = vehicle.now.wall + kTakeOffWaits;
    return answer;
  }
  return request_mode(vehicle, pilot, mode_request(vehicle, row.mode), row);
}

Answer take_off(ServedVehicle& vehicle, PilotOverride& pilot,
                std::optional<double> altitude_msl, std::optional<double> course) {
  const ModeRow& row = own_row(vehicle, VehicleMode::kTakeOff);
  if (const std::string why = why_not(vehicle, row); !why.empty())
    return {CommandResult::kTemporarilyRejected, "Take-off: " + why};
  if (vehicle.flying())
    return {CommandResult::kTemporarilyRejected, "Take-off: it flies already"};
  const double target =
      altitude_msl.value_or(vehicle.home_msl() + vehicle.settings.take_off_height);
  if (!(target >= vehicle.altitude_msl() + kMinClimb))
    return {CommandResult::kDenied, "Take-off: the altitude is not above it"};
  const TakeOffRequest request{target, course};
  if (!vehicle.armed()) {
    if (vehicle.options.make == Make::kArduPilot)
      return {CommandResult::kTemporarilyRejected, "Take-off: it is not armed"};
    const Answer answer = request_mode(vehicle, pilot, ModeRequest{row.mode}, row);
    if (answer.result != CommandResult::kAccepted) return answer;
    vehicle.take_off_when_armed = request;
    vehicle.take_off_waits_until = vehicle.now.wall + kTakeOffWaits;
    return answer;
  }
  Answer answer = request_mode(vehicle, pilot, request, row);
  if (answer.result == CommandResult::kAccepted) answer.take_off_msl = target;
  return answer;
}

Answer land(ServedVehicle& vehicle, PilotOverride& pilot, std::optional<Vec2> point,
            std::optional<double> ground_msl, std::optional<double> course) {
  if (!vehicle.known)
    return {CommandResult::kTemporarilyRejected, "Land: the simulation has not begun"};
  const LandRequest request{std::move(point),
                            ground_msl.value_or(vehicle.snapshot.ground_msl), course};
  return request_mode(vehicle, pilot, request, own_row(vehicle, VehicleMode::kLand));
}

Answer start_mission(ServedVehicle& vehicle, PilotOverride& pilot, std::uint16_t item) {
  const ModeRow& row = own_row(vehicle, VehicleMode::kMission);
  if (const std::string why = why_not(vehicle, row); !why.empty())
    return {CommandResult::kTemporarilyRejected, "Mission: " + why};
  if (item >= vehicle.mission.items.size())
    return {CommandResult::kDenied, "Mission: there is no such item"};
  return request_mode(vehicle, pilot, MissionStart{item}, row);
}

Answer select_item(ServedVehicle& vehicle, std::uint16_t item) {
  if (item >= vehicle.mission.items.size())
    return {CommandResult::kDenied, "Mission: there is no such item"};
  if (vehicle.mode() == VehicleMode::kMission && vehicle.armed()) {
    if (!vehicle.request(MissionStart{item})) return no_room();
    vehicle.mission.expected.expect(item, vehicle.now.wall);
  } else {
    vehicle.mission.selected = item;
  }
  return {};
}

Answer change_speed(ServedVehicle& vehicle, double airspeed) {
  const FlightLimits& limits = vehicle.options.limits;
  if (!(airspeed > 0 && airspeed >= limits.slowest && airspeed <= limits.fastest))
    return {CommandResult::kDenied,
            fmt::format("Speed: {:.1f} m/s is outside {:.1f} to {:.1f} m/s", airspeed,
                        limits.slowest, limits.fastest)};
  if (!vehicle.request(SpeedRequest{airspeed})) return no_room();
  vehicle.guided.airspeed = airspeed;
  return {};
}

}  // namespace skein::vehicle_services
