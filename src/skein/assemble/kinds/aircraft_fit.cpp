// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/aircraft_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "skein/assemble/kinds/sampling.h"
#include "skein/assemble/kinds/sensor_kinds.h"
#include "skein/assemble/kinds/skein_autopilot_kind.h"
#include "skein/layer/autopilot/guidance/unflyable.h"
#include "skein/layer/autopilot/modes/geofence.h"
#include "skein/scenario/numbers.h"
#include "skein/simulation/simulated_vehicle.h"

namespace skein::assemble {
namespace {

constexpr std::string_view kSimulated = "simulated";

using scenario::AircraftGroup;
using scenario::Scenario;

bool has(const AircraftGroup& group, std::initializer_list<const char*> kinds) {
  return std::any_of(
      group.sensors.begin(), group.sensors.end(), [&](const scenario::Choice& sensor) {
        return std::find(kinds.begin(), kinds.end(), sensor.kind) != kinds.end();
      });
}

bool has_plugin_sensor(const AircraftGroup& group, const KindRegistry& kinds) {
  return std::any_of(group.sensors.begin(), group.sensors.end(),
                     [&kinds](const scenario::Choice& sensor) {
                       return !kinds.plugin_of("sensor", sensor.kind).empty();
                     });
}

// The autopilot skein moves on by inertial samples and is put right by positions; or it
// takes the truth for both.
void check_sensors(const AircraftGroup& group, std::vector<Error>& found) {
  const bool inertial = has(group, {"imu", "flight", "ideal-navigation"});
  const bool position =
      has(group, {"gnss", "gnss-receiver", "flight", "ideal-navigation"});
  if (inertial && position) return;
  std::string_view missing = "there is neither of both";
  if (inertial) missing = "no sensor gives a position, it would soon be lost";
  if (position) missing = "no sensor gives inertial samples";
  found.push_back({ErrorCode::kBadInput, "sensors",
                   fmt::format("the autopilot skein needs a sensor flight, imu together "
                               "with gnss-receiver (or gnss), or ideal-navigation: {}.",
                               missing),
                   "Add one to sensors, as in sensors: [flight, fire]."});
}

void check_gains(const SkeinChoice& choice, const AircraftGroup& group,
                 const Airframe& airframe, std::vector<Error>& found) {
  const auto check = [&](bool given, bool fits, const char* key, const char* whose) {
    if (!given || fits) return;
    found.push_back({ErrorCode::kBadInput, fmt::format("autopilot.{}", key),
                     fmt::format("are for {}: on a plant of kind {} they have no effect.",
                                 whose, group.plant.kind),
                     "Leave them out, or choose another plant."});
  };
  check(choice.wing_gains.has_value(),
        std::holds_alternative<FixedWingAirframe>(airframe), "wing_gains",
        "fixed wings with six degrees of freedom");
  check(choice.rotor_gains.has_value(),
        std::holds_alternative<MultirotorAirframe>(airframe), "rotor_gains",
        "multirotors");
}

// A failsafe that watches for silence must wait for longer than what it listens to is
// silent between two samples.
void check_delay(const char* failsafe, double delay, double silence, const char* what,
                 std::vector<Error>& found) {
  if (silence <= 0 || delay > silence) return;
  found.push_back(
      {ErrorCode::kBadInput, fmt::format("autopilot.failsafe.{}.delay_s", failsafe),
       fmt::format("{:.6g} must be above {:.6g}, after which {}: the failsafe would act "
                   "from the start on.",
                   delay, silence, what),
       ""});
}

void check_delays(const SkeinChoice& choice, const Scenario& scenario,
                  const AircraftGroup& group, const simulation::VehicleParts& vehicle,
                  std::vector<Error>& found) {
  const double step = scenario.step.seconds();
  const scenario::Station& station = scenario.stations[station_of(scenario, group)];
  const Time beat = heartbeat(scenario, station);
  if (beat > Time())
    check_delay("link", choice.options.failsafe.link.delay,
                std::max({beat.seconds(), step, station.agent_period.seconds()}),
                "the ground station is received again (stations: heartbeat_s)", found);
  double oldest = 0;
  for (const scenario::Choice& sensor : group.sensors) {
    const auto age = position_age(sensor, vehicle.step.seconds());
    if (age) oldest = oldest > 0 ? std::min(oldest, *age) : *age;
  }
  check_delay("gnss", choice.options.failsafe.gnss.delay, oldest,
              "the next position has come (the receiver's period and latency)", found);
}

void check_fence(const SkeinChoice& choice, const simulation::VehicleParts& vehicle,
                 std::vector<Error>& found) {
  const autopilot::GeofenceOptions fence =
      geofence_of(choice.fence, vehicle.plant->limits());
  const VehicleState& start = vehicle.state;
  const double clearance =
      autopilot::Geofence(fence).clearance(start.p_N, !start.on_ground);
  if (clearance > 0) return;
  found.push_back(
      {ErrorCode::kBadInput, "autopilot.fence",
       fmt::format("does not hold the start at {:.0f} m north, {:.0f} m east, {:.0f} m "
                   "above sea level: it is {:.0f} m outside{}.",
                   start.p_N.x(), start.p_N.y(), -start.p_N.z(), -clearance,
                   fence.margin > 0
                       ? fmt::format(", with the margin of {:.6g} m", fence.margin)
                       : ""),
       "Widen the fence or move the start."});
}

// Which kinds take actuators is known of ours only, so others may have got too long a
// step.
void check_step(const AircraftGroup& group, const simulation::VehicleParts& vehicle,
                std::vector<Error>& found) {
  if (group.flight_step || vehicle.step <= kFlightStep ||
      std::holds_alternative<SelfStabilised>(vehicle.plant->airframe()))
    return;
  found.push_back(
      {ErrorCode::kBadInput, "flight_step_s",
       fmt::format("is needed: the plant {} takes actuators, steps of {} s are "
                   "too long for it.",
                   group.plant.kind, scenario::seconds_text(vehicle.step)),
       "Skein's own plants are stepped by 0.01 s."});
}

// Agents give no airspeed: at its altitude the air must carry it at cruise.
void check_air(const AircraftGroup& group, const simulation::VehicleParts& vehicle,
               std::vector<Error>& found) {
  const VehicleState& start = vehicle.state;
  double altitude = -start.p_N.z();
  if (start.on_ground) {  // above the ground, not above the hand that may hold it
    const VehicleState at_zero =
        vehicle.plant->start({.on_ground = true, .held = start.held});
    altitude += group.altitude_agl + at_zero.p_N.z();
  }
  AutopilotCommand stay;
  stay.guidance = HoldPosition{geo::horizontal(start.p_N)};
  stay.altitude_msl = altitude;
  if (auto reason = autopilot::unflyable(stay, vehicle.plant->limits(), Vec2::Zero()))
    found.push_back({ErrorCode::kBadInput, "altitude_agl_m", *reason + ".",
                     "Fly lower, or choose another plant."});
}

void warn_about_rotors(const SkeinChoice& choice, const AircraftGroup& group,
                       const simulation::Entity& aircraft,
                       std::vector<std::string>& found) {
  const Airframe airframe = parts_of(aircraft).plant->airframe();
  const auto* rotors = std::get_if<MultirotorAirframe>(&airframe);
  if (!rotors) return;
  autopilot::MultirotorGains gains = choice.options.rotor_gains;
  if (const AircraftGains of_file = gains_of(group.plant); of_file.rotors)
    gains = *of_file.rotors;
  if (choice.rotor_gains) gains = *choice.rotor_gains;
  const autopilot::MultirotorSetup setup(*rotors, gains);
  // Measured: with the defaults it hovers well up to a ratio of 1, from 1.2 on it swings.
  if (setup.gains.tilt_gain < setup.gains.velocity_gain)
    found.push_back(fmt::format(
        "{}: its motors with a lag of {:.3g} s let it tilt with a gain of {:.3g} /s, "
        "less "
        "than velocity_gain_per_s, {:.3g}: it will swing. Lower velocity_gain_per_s and "
        "position_gain_per_s in the same proportion.",
        aircraft.name, setup.motor_lag, setup.gains.tilt_gain,
        setup.gains.velocity_gain));
}

}  // namespace

std::size_t station_of(const Scenario& scenario, const AircraftGroup& group) {
  const auto named =
      std::find_if(scenario.stations.begin(), scenario.stations.end(),
                   [&](const scenario::Station& s) { return s.name == group.station; });
  return named == scenario.stations.end()
             ? 0
             : static_cast<std::size_t>(named - scenario.stations.begin());
}

Time heartbeat(const Scenario& scenario, const scenario::Station& station) {
  if (station.heartbeat) return *station.heartbeat;
  const bool watched =
      std::any_of(scenario.aircraft.begin(), scenario.aircraft.end(),
                  [](const AircraftGroup& g) { return g.autopilot.kind == "skein"; });
  return watched ? Time::from_seconds(1) : Time();
}

std::vector<Error> incompatibilities(const Scenario& scenario, const KindRegistry& kinds,
                                     const AircraftGroup& group,
                                     const simulation::Entity& aircraft) {
  std::vector<Error> found;
  // What is not simulated brings parts of its own.
  if (group.vehicle.kind != kSimulated) return found;
  const simulation::VehicleParts& vehicle = parts_of(aircraft);
  check_step(group, vehicle, found);
  check_air(group, vehicle, found);
  if (group.autopilot.kind == "skein") {
    const auto& choice = group.autopilot.as<SkeinChoice>();
    if (!has_plugin_sensor(group, kinds)) check_sensors(group, found);
    check_gains(choice, group, vehicle.plant->airframe(), found);
    check_delays(choice, scenario, group, vehicle, found);
    check_fence(choice, vehicle, found);
  }
  for (Error& error : found) error.place = aircraft.name + ": " + error.place;
  return found;
}

std::vector<std::string> warnings(const Scenario& scenario, const AircraftGroup& group,
                                  const simulation::Entity& aircraft) {
  std::vector<std::string> found;
  if (group.autopilot.kind != "skein" || group.vehicle.kind != kSimulated) return found;
  const auto& choice = group.autopilot.as<SkeinChoice>();
  const autopilot::FailsafeRule& link = choice.options.failsafe.link;
  if (heartbeat(scenario, scenario.stations[station_of(scenario, group)]) <= Time() &&
      link.reaction != FailsafeReaction::kNone)
    found.push_back(fmt::format(
        "stations: heartbeat_s: the station sends no heartbeats. Where {:.6g} s pass "
        "without an order the failsafe link of {} acts.",
        link.delay, aircraft.name));
  warn_about_rotors(choice, group, aircraft, found);
  return found;
}

}  // namespace skein::assemble
