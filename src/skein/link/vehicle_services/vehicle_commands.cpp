// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/vehicle_commands.h"

#include <cmath>
#include <optional>

#include "skein/link/mavlink/flight_modes.h"
#include "skein/link/vehicle_services/flight_modes.h"
#include "skein/link/vehicle_services/guided_inputs.h"
#include "skein/link/vehicle_services/message_numbers.h"
#include "skein/link/vehicle_services/places.h"

namespace skein::vehicle_services {
namespace {

using mavlink::CommandId;
using mavlink::CommandResult;

// A parameter that says nothing is NaN, or 0 with ArduPilot.
std::optional<double> course_of(float degrees, Make make) {
  if (!std::isfinite(degrees) || (make == Make::kArduPilot && degrees == 0))
    return std::nullopt;
  return geo::radians(static_cast<double>(degrees));
}

// Where a command has its place; an answer where that is none.
struct PlaceOrAnswer {
  std::optional<Vec2> point;
  std::optional<double> altitude_msl;
  std::optional<Answer> refused;
};
PlaceOrAnswer place_of(const Command& command, const ServedVehicle& vehicle) {
  PlaceOrAnswer place;
  if (command.has_altitude()) {
    place.altitude_msl = altitude_msl(command.frame, command.z, vehicle.home_msl());
    if (!place.altitude_msl) place.refused = CommandResult::kUnsupportedFrame;
    if (place.altitude_msl && !is_altitude(*place.altitude_msl))
      place.refused = Answer(CommandResult::kDenied, "The altitude is none");
  }
  if (!command.has_place()) return place;
  // Floats are good to a metre only.
  if (!command.in_integers) place.refused = CommandResult::kIntOnly;
  place.point = map_point(vehicle.frame, command.x, command.y);
  if (!place.point && !place.refused)
    place.refused = Answer(CommandResult::kDenied, "The place is too far away");
  return place;
}

Answer set_mode(const Command& command, VehicleParts& parts) {
  const auto number_of = [](float value) {
    return rounded<std::uint32_t>(static_cast<double>(value));
  };
  if ((number_of(command.param(1)) & mavlink::kModeCustom) == 0)
    return {CommandResult::kDenied, "Mode: only those of its make"};
  const std::uint32_t number = number_of(command.param(2));
  return set_mode(parts.vehicle, parts.pilot,
                  parts.vehicle.options.make == Make::kPx4
                      ? px4_mode(number & 0xff, number_of(command.param(3)) & 0xff)
                      : number);
}

Answer take_off(const Command& command, VehicleParts& parts) {
  const PlaceOrAnswer place = place_of(command, parts.vehicle);
  // Where it takes off is where it stands, whatever the command says.
  if (place.refused && place.refused->result != CommandResult::kIntOnly)
    return *place.refused;
  return take_off(parts.vehicle, parts.pilot, place.altitude_msl,
                  course_of(command.param(4), parts.vehicle.options.make));
}

Answer land(const Command& command, VehicleParts& parts) {
  const PlaceOrAnswer place = place_of(command, parts.vehicle);
  if (!command.has_place())
    return land(parts.vehicle, parts.pilot, std::nullopt, std::nullopt, std::nullopt);
  if (place.refused) return *place.refused;
  return land(parts.vehicle, parts.pilot, place.point, place.altitude_msl,
              course_of(command.param(4), parts.vehicle.options.make));
}

Answer hold(VehicleParts& parts) {
  const VehicleServerOptions& options = parts.vehicle.options;
  return set_mode(parts.vehicle, parts.pilot,
                  row_of(VehicleMode::kHold, options.make, options.hovers));
}

// Another place, another altitude, or with neither: stay here.
Answer reposition(const Command& command, VehicleParts& parts) {
  ServedVehicle& vehicle = parts.vehicle;
  const VehicleServerOptions& options = vehicle.options;
  const PlaceOrAnswer place = place_of(command, vehicle);
  if (place.refused) return *place.refused;
  if (!place.point && !place.altitude_msl) {
    const bool heading = std::isfinite(command.param(4)) && command.param(4) != 0;
    return heading ? Answer(CommandResult::kUnsupported) : hold(parts);
  }
  const auto speed = static_cast<double>(command.param(1));
  if (speed > 0 && (speed < options.limits.slowest || speed > options.limits.fastest))
    return {CommandResult::kDenied, "Reposition: it does not fly at that speed"};
  constexpr int kChangeMode = 1;
  if (vehicle.mode() != VehicleMode::kGuided) {
    const bool may_change = (rounded<std::uint32_t>(command.param(2)) & kChangeMode) != 0;
    if (!vehicle.armed() || !vehicle.flying() || !may_change)
      return {CommandResult::kTemporarilyRejected,
              "Reposition: " + why_not_guided(vehicle)};
    const Answer answer =
        set_mode(vehicle, parts.pilot, row_of_place(options.make, options.hovers));
    if (answer.result != CommandResult::kAccepted) return answer;
  }
  if (const std::string why = why_not_guided(vehicle); !why.empty())
    return {CommandResult::kTemporarilyRejected, "Reposition: " + why};
  if (!place.point) return change_altitude(vehicle, *place.altitude_msl, 0);
  FlyToRequest request =
      default_fly_to(vehicle, Vec3(place.point->x(), place.point->y(),
                                   -place.altitude_msl.value_or(vehicle.altitude_msl())));
  if (speed > 0) request.airspeed = speed;
  if (!options.hovers && std::isfinite(command.param(3)) && command.param(3) != 0)
    request.radius = std::abs(static_cast<double>(command.param(3)));
  if (!options.hovers && options.make == Make::kArduPilot && command.param(4) == 1)
    request.clockwise = false;
  return fly_to(vehicle, request);
}

Answer change_speed(const Command& command, VehicleParts& parts) {
  const float type = command.param(1), speed = command.param(2);
  const bool over_ground = type == 1;
  if (type != 0 && !(over_ground && parts.vehicle.options.hovers))
    return {CommandResult::kDenied, "Speed: only airspeeds are supported"};
  if (speed == -1) return {};  // no change; what else it says is of the throttle
  return change_speed(parts.vehicle, static_cast<double>(speed));
}

Answer set_home(const Command& command, VehicleParts& parts) {
  ServedVehicle& vehicle = parts.vehicle;
  if (!vehicle.options.home_can_be_set)
    return {CommandResult::kDenied, "Home: it stays where it is"};
  if (!vehicle.known || !vehicle.snapshot.condition.position)
    return {CommandResult::kTemporarilyRejected, "Home: its position is not known"};
  if (command.param(1) == 1) {
    Vec3 here = vehicle.snapshot.motion.p_N;
    here.z() = -vehicle.snapshot.ground_msl;
    vehicle.home_setpoint = here;
    return {};
  }
  const PlaceOrAnswer place = place_of(command, vehicle);
  if (place.refused) return *place.refused;
  if (!place.point || !place.altitude_msl)
    return {CommandResult::kDenied, "Home: a place is missing"};
  vehicle.home_setpoint = Vec3(place.point->x(), place.point->y(), -*place.altitude_msl);
  return {};
}

Answer pause_or_continue(const Command& command, VehicleParts& parts) {
  ServedVehicle& vehicle = parts.vehicle;
  const VehicleServerOptions& options = vehicle.options;
  if (command.param(1) == 0) {
    if (vehicle.mode() != VehicleMode::kMission)
      return {CommandResult::kTemporarilyRejected, "Pause: it flies no mission"};
    return hold(parts);
  }
  if (command.param(1) != 1) return CommandResult::kDenied;
  if (vehicle.mode() == VehicleMode::kMission) return {};
  return set_mode(vehicle, parts.pilot,
                  row_of(VehicleMode::kMission, options.make, options.hovers));
}

// The number of an item as ground stations have it, from 0; none for home and below.
std::optional<std::uint16_t> item_of(float number, const ServedVehicle& vehicle) {
  const float first = vehicle.mission.first;
  if (!(number >= first && number < 65'535)) return std::nullopt;
  return static_cast<std::uint16_t>(number - first);
}

Answer select_item(const Command& command, VehicleParts& parts) {
  if (command.param(1) == -1) return {};  // as it is
  const auto item = item_of(command.param(1), parts.vehicle);
  if (!item) return {CommandResult::kDenied, "Mission: there is no such item"};
  return select_item(parts.vehicle, *item);
}

Answer start_mission(const Command& command, VehicleParts& parts) {
  // 0: the item that was selected, or the first.
  const auto item = command.param(1) == 0 ? parts.vehicle.mission.selected.value_or(0)
                                          : item_of(command.param(1), parts.vehicle);
  if (!item) return {CommandResult::kDenied, "Mission: there is no such item"};
  return start_mission(parts.vehicle, parts.pilot, *item);
}

Answer guided(const Command& command, VehicleParts& parts) {
  ServedVehicle& vehicle = parts.vehicle;
  if (vehicle.options.make != Make::kArduPilot || vehicle.options.hovers)
    return CommandResult::kUnsupported;
  if (const std::string why = why_not_guided(vehicle); !why.empty())
    return {CommandResult::kTemporarilyRejected, "Guided: " + why};
  if (command.id == CommandId::kGuidedSpeed) return change_speed(command, parts);
  if (command.id == CommandId::kGuidedHeading) {
    const auto degrees = static_cast<double>(command.param(2));
    const bool over_ground = command.param(1) == 0;
    if (!over_ground && command.param(1) != 1) return CommandResult::kDenied;
    return keep_heading(vehicle, geo::radians(degrees), over_ground);
  }
  if (!command.in_integers) return CommandResult::kIntOnly;
  const auto altitude = altitude_msl(command.frame, command.z, vehicle.home_msl());
  if (!altitude) return CommandResult::kUnsupportedFrame;
  return change_altitude(vehicle, *altitude, static_cast<double>(command.param(3)));
}

}  // namespace

Answer execute(const Command& command, VehicleParts& parts) {
  ServedVehicle& vehicle = parts.vehicle;
  const VehicleServerOptions& options = vehicle.options;
  switch (command.id) {
    case CommandId::kArm:
      if (command.param(1) != 0 && command.param(1) != 1) return CommandResult::kDenied;
      return arm(vehicle, command.param(1) == 1,
                 command.param(2) == mavlink::kForceArming);
    case CommandId::kSetMode:
      return set_mode(command, parts);
    case CommandId::kTakeOff:
      return take_off(command, parts);
    case CommandId::kLand:
      return land(command, parts);
    case CommandId::kReturn:
      return set_mode(vehicle, parts.pilot,
                      row_of(VehicleMode::kReturn, options.make, options.hovers));
    case CommandId::kLoiter:
    case CommandId::kLoiterTime:  // outside of a mission nothing comes after it
      return hold(parts);
    case CommandId::kReposition:
      return reposition(command, parts);
    case CommandId::kChangeSpeed:
      return change_speed(command, parts);
    case CommandId::kMissionStart:
      return start_mission(command, parts);
    case CommandId::kPauseContinue:
      return pause_or_continue(command, parts);
    case CommandId::kSetMissionCurrent:
      return select_item(command, parts);
    case CommandId::kSetHome:
      return set_home(command, parts);
    case CommandId::kFenceEnable:
      parts.parameters.set(fence_parameter(options.make), command.param(1) != 0);
      return {};
    case CommandId::kReboot:
      if (vehicle.flying()) return {CommandResult::kDenied, "Reboot: it is in flight"};
      return CommandResult::kUnsupported;
    case CommandId::kGuidedSpeed:
    case CommandId::kGuidedAltitude:
    case CommandId::kGuidedHeading:
      return guided(command, parts);
    default:
      return CommandResult::kUnsupported;
  }
}

}  // namespace skein::vehicle_services
