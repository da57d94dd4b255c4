// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/guided_inputs.h"

#include <algorithm>
#include <cmath>

#include "skein/link/vehicle_services/places.h"

namespace skein::vehicle_services {
namespace {

using mavlink::CommandResult;
using mavlink::MissionResult;

const Time kBankEnds = Time::from_seconds(1);        // a stream of attitudes
const Time kHeadingAgain = Time::from_seconds(0.2);  // of the run
constexpr double kSamePlace = 0.01;                  // [m]
constexpr double kAltitudeTime = 3;                  // to an altitude, when near it [s]

bool same(const FlyToRequest& a, const FlyToRequest& b) {
  return (a.p_N - b.p_N).norm() < kSamePlace && a.airspeed == b.airspeed &&
         a.radius == b.radius && a.clockwise == b.clockwise;
}

bool flies_by_attitudes(const ServedVehicle& vehicle) {
  return vehicle.guided.last_bank &&
         vehicle.now.wall - *vehicle.guided.last_bank < kBankEnds;
}

// Towards the altitude that was commanded last [m/s].
double climb_rate(const ServedVehicle& vehicle) {
  const FlightLimits& limits = vehicle.options.limits;
  const double asked = vehicle.guided.climb_rate;
  const double up = asked > 0 ? std::min(asked, limits.climb_rate) : limits.climb_rate;
  const double down = asked > 0 ? std::min(asked, limits.sink_rate) : limits.sink_rate;
  const double error = *vehicle.guided.altitude_msl - vehicle.altitude_msl();
  return std::clamp(error / kAltitudeTime, -down, up);
}

// The velocity over ground of an airspeed that is flown along a heading or course.
Vec2 velocity_along(const ServedVehicle& vehicle, double direction, bool over_ground) {
  const Vec2 along = geo::unit(direction), wind = vehicle.snapshot.motion.wind_N;
  const double airspeed = vehicle.airspeed();
  if (!over_ground) return along * airspeed + wind;
  const double across = geo::cross(along, wind);
  const double left = airspeed * airspeed - across * across;
  return along * (std::sqrt(std::max(left, 0.0)) + along.dot(wind));
}

}  // namespace

std::string why_not_guided(const ServedVehicle& vehicle) {
  if (!vehicle.known) return "the simulation has not begun";
  if (!vehicle.armed()) return "it is not armed";
  if (vehicle.mode() != VehicleMode::kGuided) return "its mode is not guided";
  if (!vehicle.flying()) return "it has not taken off";
  return {};
}

FlyToRequest default_fly_to(const ServedVehicle& vehicle, const Vec3& p_N) {
  FlyToRequest request;
  request.p_N = p_N;
  request.radius = vehicle.options.hovers ? 0 : vehicle.settings.loiter_radius;
  request.clockwise = vehicle.settings.clockwise;
  return request;
}

Answer fly_to(ServedVehicle& vehicle, const FlyToRequest& request) {
  GuidedState& guided = vehicle.guided;
  if (!(guided.place && same(*guided.place, request)) && !vehicle.request(request))
    return {CommandResult::kTemporarilyRejected, "The simulation is busy"};
  guided.place = request;
  guided.altitude_msl = -request.p_N.z();
  guided.heading.reset();
  guided.last_bank.reset();
  return {};
}

Answer change_altitude(ServedVehicle& vehicle, double altitude_msl, double rate) {
  if (!is_altitude(altitude_msl) || !(rate >= 0))
    return {CommandResult::kDenied, "Altitude: it is none"};
  GuidedState& guided = vehicle.guided;
  guided.climb_rate = rate;
  guided.altitude_msl = altitude_msl;
  if (guided.heading || flies_by_attitudes(vehicle)) return {};
  FlyToRequest there =
      guided.place.value_or(default_fly_to(vehicle, vehicle.snapshot.motion.p_N));
  there.p_N.z() = -altitude_msl;
  return fly_to(vehicle, there);
}

Answer keep_heading(ServedVehicle& vehicle, double heading, bool over_ground) {
  if (!std::isfinite(heading))
    return {CommandResult::kDenied, "Heading: it is no number"};
  GuidedState& guided = vehicle.guided;
  if (!guided.altitude_msl) guided.altitude_msl = vehicle.altitude_msl();
  guided.heading = heading;
  guided.over_ground = over_ground;
  guided.next_heading = vehicle.now.simulated;
  guided.place.reset();
  guided.last_bank.reset();
  return {};
}

void step_guided(ServedVehicle& vehicle) {
  GuidedState& guided = vehicle.guided;
  if (!guided.heading || vehicle.now.simulated < guided.next_heading) return;
  if (!why_not_guided(vehicle).empty()) return guided.heading.reset();
  TrackSetpoint setpoint;
  setpoint.p_N = vehicle.snapshot.motion.p_N;
  setpoint.p_N.z() = -*guided.altitude_msl;
  setpoint.v_N.head<2>() = velocity_along(vehicle, *guided.heading, guided.over_ground);
  vehicle.request(setpoint);
  guided.next_heading = vehicle.now.simulated + kHeadingAgain;
}

namespace {

// The attitude counts; or, as ArduPilot's fixed wings take it, of the attitude the roll
// alone: its own bit and those of pitch and yaw rate say to ignore them, that of the roll
// rate does not.
bool takes_roll(std::uint8_t mask) {
  constexpr std::uint8_t kOnlyRoll = mavlink::kIgnoreAttitude | 0b110;
  constexpr std::uint8_t kCounts = mavlink::kIgnoreAttitude | 0b111;
  return (mask & mavlink::kIgnoreAttitude) == 0 || (mask & kCounts) == kOnlyRoll;
}

}  // namespace

void handle(const mavlink::SetAttitudeTarget& m, ServedVehicle& vehicle) {
  if (vehicle.options.hovers || !takes_roll(m.type_mask)) return;
  const Quat q_NB(static_cast<double>(m.q[0]), static_cast<double>(m.q[1]),
                  static_cast<double>(m.q[2]), static_cast<double>(m.q[3]));
  // It is to be a rotation, but for the rounding of floats.
  if (!(std::abs(q_NB.norm() - 1) < 0.01)) return;
  GuidedState& guided = vehicle.guided;
  guided.last_setpoint = vehicle.now.wall;
  if (!why_not_guided(vehicle).empty()) return;
  if (!guided.altitude_msl) guided.altitude_msl = vehicle.altitude_msl();
  guided.place.reset();
  guided.heading.reset();
  guided.last_bank = vehicle.now.wall;
  BankSetpoint setpoint;
  setpoint.roll = geo::to_euler(q_NB.normalized()).roll;
  setpoint.altitude_msl = *guided.altitude_msl;
  setpoint.climb_rate = climb_rate(vehicle);
  setpoint.airspeed = vehicle.airspeed();
  vehicle.request(setpoint);
}

std::optional<MissionResult> guided_item(const mavlink::MissionItemInt& item,
                                         ServedVehicle& vehicle) {
  constexpr std::uint8_t kGoThere = 2, kAltitudeOnly = 3;
  if (item.current != kGoThere && item.current != kAltitudeOnly) return std::nullopt;
  if (const std::string why = why_not_guided(vehicle); !why.empty()) {
    vehicle.say(mavlink::Severity::kWarning, "Guided: " + why);
    return MissionResult::kDenied;
  }
  const auto altitude =
      altitude_msl(item.frame, static_cast<double>(item.z), vehicle.home_msl());
  if (!altitude) return MissionResult::kUnsupportedFrame;
  if (!is_altitude(*altitude)) return MissionResult::kInvalidZ;
  Answer answer;
  if (item.current == kAltitudeOnly) {
    answer = change_altitude(vehicle, *altitude, 0);
  } else {
    const auto point = map_point(vehicle.frame, coordinate(item.frame, item.x),
                                 coordinate(item.frame, item.y));
    if (!point) return MissionResult::kInvalidX;
    answer = fly_to(vehicle,
                    default_fly_to(vehicle, Vec3(point->x(), point->y(), -*altitude)));
  }
  return answer.result == CommandResult::kAccepted ? MissionResult::kAccepted
                                                   : MissionResult::kDenied;
}

}  // namespace skein::vehicle_services
