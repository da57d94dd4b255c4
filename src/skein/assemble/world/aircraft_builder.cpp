// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/aircraft_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "skein/assemble/kinds/aircraft_fit.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/routine_periods.h"
#include "skein/assemble/kinds/sampling.h"
#include "skein/assemble/kinds/sensor_kinds.h"
#include "skein/assemble/kinds/team_setup.h"
#include "skein/assemble/kinds/vehicle_context.h"
#include "skein/assemble/world/placement.h"
#include "skein/assemble/world/presence.h"
#include "skein/assemble/world/server_memory.h"
#include "skein/geo/polygon.h"
#include "skein/layer/sensory/sensor_suite.h"
#include "skein/link/world_link/agent_parts.h"
#include "skein/role/agent.h"
#include "skein/solve/path/aa_star.h"

namespace skein::assemble {
namespace {

using scenario::AircraftGroup;

// A suite's sensors one by one, so that each can fail by itself.
std::vector<sensory::SensorSuite::Part> unpacked(const std::string& kind,
                                                 std::unique_ptr<Sensor> sensor) {
  if (auto* suite = dynamic_cast<sensory::SensorSuite*>(sensor.get()))
    return suite->take();
  std::vector<sensory::SensorSuite::Part> one;
  one.push_back({kind, std::move(sensor)});
  return one;
}

// What the suite `flight` holds, as single sensors are called.
constexpr std::string_view kSuite = "flight";
constexpr std::array<std::string_view, 7> kInSuite = {
    "imu", "gnss-receiver", "barometer", "magnetometer", "airspeed", "height", "power"};

// The number of a sensor among those of its kind on board, which a suite holds too: each
// has errors of its own.
std::uint32_t next_instance(const std::string& kind,
                            const std::map<std::string, std::uint32_t>& mounted) {
  const auto count = [&](const std::string& name) {
    const auto found = mounted.find(name);
    return found == mounted.end() ? 0 : found->second;
  };
  std::uint32_t next = count(kind);
  if (kind == kSuite)
    for (const std::string_view part : kInSuite)
      next = std::max(next, count(std::string(part)));
  return next;
}

std::uint8_t flight_sensors_in(const std::vector<std::string>& kinds) {
  unsigned bits = 0;
  for (std::size_t k = 0; k < kFlightSensors; ++k)
    if (std::find(kinds.begin(), kinds.end(), name_of(static_cast<FlightSensor>(k))) !=
        kinds.end())
      bits |= 1u << k;
  return static_cast<std::uint8_t>(bits);
}

// An error of the aircraft called `name`, if it does not say where.
Error at(const std::string& name, Error error) {
  if (error.place.empty()) error.place = name;
  return error;
}

// Whether whoever puts it on the ground turns it into the wind: a wing that is given no
// heading, or that is thrown by hand, where there is wind to feel.
bool faces_wind(const scenario::Start& start, const Airframe& airframe,
                const Vec3& wind_N) {
  constexpr double kCalm = 0.3;  // [m/s]
  const auto* wing = std::get_if<FixedWingAirframe>(&airframe);
  return start.on_ground && wing &&
         (!start.heading || (start.held && wing->hand_launched)) &&
         geo::horizontal(wind_N).norm() > kCalm;
}

}  // namespace

std::vector<std::vector<std::string>> aircraft_names(const scenario::Scenario& scenario) {
  std::map<std::string, int> named;  // how many aircraft have a group's name
  std::vector<std::vector<std::string>> all;
  for (const AircraftGroup& group : scenario.aircraft) {
    all.emplace_back();
    for (int i = 0; i < group.count; ++i)
      all.back().push_back(fmt::format("{}-{}", group.name, ++named[group.name]));
  }
  return all;
}

AircraftBuilder::AircraftBuilder(const scenario::Scenario& scenario,
                                 const KindsByRole& kinds,
                                 std::shared_ptr<const Terrain> map,
                                 const std::vector<Zone>& zones, const WindField& wind,
                                 const OutsideLinks& links, RecordedReports* recorded)
    : scenario_(scenario),
      kinds_(kinds),
      tasks_(std::make_shared<const TaskKinds>(kinds.task)),
      map_(std::move(map)),
      zones_(zones),
      wind_(wind),
      links_(links),
      recorded_(recorded),
      planner_(std::make_shared<solve::AaStar>()),
      names_(aircraft_names(scenario)),
      place_period_(routine_periods(scenario, kinds).place) {
  for (std::size_t k = 0; k < names_.size(); ++k)
    if (scenario.aircraft[k].vehicle.kind == "simulated")
      simulated_.insert(names_[k].begin(), names_[k].end());
}

AircraftContext AircraftBuilder::context_of(const AircraftGroup& group, int index,
                                            EntityId self, EntityId station) {
  AircraftContext context;
  context.seed = scenario_.seed;
  context.self = self;
  context.station = station;
  context.agent_period = group.agent_period;
  context.index = static_cast<std::size_t>(index);
  context.altitude_agl = group.altitude_agl;
  context.map = map_;
  context.zones = zones_;
  context.phenomena = scenario_.environment.phenomena.size();
  context.planner = planner_;
  context.tasks = tasks_;
  context.place_period = place_period_;
  context.gains = gains_of(group.plant);
  context.shared = &shared_[&group];
  context.receives_station =
      heartbeat(scenario_, scenario_.stations[station_of(scenario_, group)]) > Time();
  return context;
}

Result<void> AircraftBuilder::add_plant(const AircraftGroup& group,
                                        AircraftContext& context,
                                        simulation::VehicleParts& vehicle) {
  auto nominal = nominal_plant(group, context);
  if (!nominal) return nominal.error();
  context.limits = nominal.value()->limits();
  context.airframe = nominal.value()->airframe();
  vehicle.plant = nominal.value();
  if (group.parameter_spread > 0) {
    context.parameter_spread = group.parameter_spread;
    auto own = kinds_.plant.make(group.plant, context);
    if (!own) return own.error();
    vehicle.plant = std::move(own).value();
  }
  const auto step = flight_step(scenario_, group);
  if (!step) return at(vehicle.name, step.error());
  vehicle.step = step.value();
  return {};
}

Result<AircraftBuilder::Flown> AircraftBuilder::make_vehicle(
    const AircraftGroup& group, int index, const AircraftContext& context,
    const Parts& mounted, simulation::VehicleParts& vehicle) {
  const std::string name = vehicle.name;
  Flown flown;
  auto made = kinds_.vehicle.make(
      group.vehicle,
      VehicleContext{.aircraft = context,
                     .scenario = scenario_,
                     .group = group,
                     .index = index,
                     .parts = vehicle,
                     .mounted = mounted,
                     .kinds = kinds_,
                     .links = links_.vehicles,
                     .remotes = links_.entities,
                     .modem = links_.modem,
                     .agent = flown.agent,
                     .recorded = recorded_ ? &(*recorded_)[context.self] : nullptr,
                     .simulated = simulated_,
                     .vehicles = made_});
  if (!made) return at(name, made.error());
  flown.vehicle = std::move(made).value();
  (*made_)[name] = flown.vehicle.get();
  return flown;
}

Result<simulation::Entity> AircraftBuilder::make(const AircraftGroup& group, int index,
                                                 EntityId self, EntityId station) {
  const auto group_index = static_cast<std::size_t>(&group - scenario_.aircraft.data());
  const std::string& name = names_.at(group_index).at(static_cast<std::size_t>(index));
  AircraftContext context = context_of(group, index, self, station);

  simulation::VehicleParts vehicle;
  vehicle.name = name;
  if (auto added = add_plant(group, context, vehicle); !added) return added.error();
  if (auto placed = put(name, group, index, vehicle); !placed) return placed.error();
  context.initial = as_estimate(vehicle.state, Time());
  context.on_ground = vehicle.state.on_ground;

  for (const scenario::Choice& sensor : group.sensors)
    context.has_position |= position_age(sensor, vehicle.step.seconds()).has_value();
  const auto mounted = mount_sensors(group, context, vehicle);
  if (!mounted) return mounted.error();
  context.fitted = flight_sensors_in(mounted.value().sensors);
  context.watchers = watchers(group, self);
  context.team = onboard_team(scenario_, station_of(scenario_, group), context, kinds_);
  finds_aircraft_ |= context.finds_aircraft;

  auto flown = make_vehicle(group, index, context, mounted.value(), vehicle);
  if (!flown) return flown.error();
  auto agent = kinds_.agent.make(group.agent, context);
  if (!agent) return agent.error();

  last_ = {self,
           name,
           group.name,
           geo::horizontal(context.initial.p_N),
           context.has_camera,
           context.has_fire_sensor};
  simulation::Entity entity;
  entity.name = name;
  entity.kind = "aircraft";
  entity.reality = reality_of(group);
  entity.sends = transmitters(group.transmits);
  entity.address = team_address(self);
  entity.agent = std::move(agent).value();
  entity.vehicle = std::move(flown.value().vehicle);
  entity.agent_period = group.agent_period;
  if (flown.value().agent) {  // it thinks elsewhere; what it says is taken at once
    entity.agent = std::move(flown.value().agent);
    entity.agent_period = scenario_.step;
  } else if (links_.world) {
    entity.agent = std::make_unique<world_link::ConnectedAgent>(std::move(entity.agent),
                                                                self, *links_.world);
  }
  entity.active = presence(group, index, scenario_.duration);
  return entity;
}

// A group of which one sensor cannot be made is reported where its aircraft are made.
bool AircraftBuilder::finds_aircraft(const AircraftGroup& group) {
  const auto [found, first] = finds_.try_emplace(&group, false);
  if (!first) return found->second;
  AircraftContext context;
  context.seed = scenario_.seed;
  context.agent_period = group.agent_period;
  context.phenomena = scenario_.environment.phenomena.size();
  context.map = map_;
  for (const scenario::Choice& choice : group.sensors)
    if (const auto made = kinds_.sensor.make(choice, context))
      found->second |= made.value()->finds_aircraft();
  return found->second;
}

// The others of its team that find aircraft.
std::vector<EntityId> AircraftBuilder::watchers(const AircraftGroup& group,
                                                EntityId self) {
  std::vector<EntityId> all;
  EntityId id{static_cast<std::uint32_t>(scenario_.stations.size())};
  const std::size_t station = station_of(scenario_, group);
  for (const AircraftGroup& other : scenario_.aircraft) {
    const bool theirs = station_of(scenario_, other) == station && other.count > 0 &&
                        finds_aircraft(other);
    for (int i = 0; i < other.count; ++i, ++id.value)
      if (theirs && id != self) all.push_back(id);
  }
  return all;
}

Result<std::shared_ptr<const Plant>> AircraftBuilder::nominal_plant(
    const AircraftGroup& group, const AircraftContext& context) {
  if (const auto known = plants_.find(&group); known != plants_.end())
    return known->second;
  auto made = kinds_.plant.make(group.plant, context);
  if (!made) return made.error();
  return plants_.emplace(&group, std::move(made).value()).first->second;
}

// In level flight at cruise, in the wind of that place, or on the ground.
Result<void> AircraftBuilder::put(const std::string& name, const AircraftGroup& group,
                                  int index, simulation::VehicleParts& vehicle) const {
  const Place place = place_at_start(group.start, index, group.count);
  const double ground = map_->elevation_msl(place.position);
  const double altitude =
      group.start.on_ground
          ? ground
          : group.start.altitude_msl.value_or(ground + group.altitude_agl);
  if (altitude <= ground && !group.start.on_ground)
    return Error{ErrorCode::kBadInput, name,
                 fmt::format("starts inside terrain: at {:.1f} m above mean sea level, "
                             "where the ground is at {:.1f} m.",
                             altitude, ground),
                 "Raise start.altitude_msl_m or leave it out."};
  if (group.start.on_ground && plant_is_simulated(group.vehicle) &&
      std::holds_alternative<SelfStabilised>(vehicle.plant->airframe()))
    return Error{
        ErrorCode::kBadInput, name,
        fmt::format("the plant {} cannot stand on the ground.", group.plant.kind),
        "Leave start.on_ground out, or choose another plant."};
  VehicleStart start;
  start.p_N = {place.position.x(), place.position.y(), -altitude};
  start.wind_N = wind_.wind(start.p_N, Time());
  start.heading = place.heading;
  if (faces_wind(group.start, vehicle.plant->airframe(), start.wind_N))
    start.heading = geo::bearing(-geo::horizontal(start.wind_N));
  start.on_ground = group.start.on_ground;
  start.held = group.start.held;
  vehicle.state = vehicle.plant->start(start);
  vehicle.air.wind_N = start.wind_N;
  for (const Zone& zone : zones_)
    if (covers(zone, place.position) && holds_at(zone, altitude, group.join.seconds()))
      return Error{
          ErrorCode::kBadInput, name,
          fmt::format("starts inside the no-fly zone {}, at {:.0f} m north, "
                      "{:.0f} m east, {:.0f} m above mean sea level.",
                      zone.name, place.position.x(), place.position.y(), altitude),
          "Move its start or the zone."};
  return {};
}

Result<Parts> AircraftBuilder::mount_sensors(const AircraftGroup& group,
                                             AircraftContext& context,
                                             simulation::VehicleParts& vehicle) const {
  Parts parts;
  parts.airframe = context.airframe;
  std::map<std::string, std::uint32_t> of_kind;
  for (const scenario::Choice& choice : group.sensors) {
    context.instance = next_instance(choice.kind, of_kind);
    of_kind[choice.kind] = context.instance + 1;
    auto sensor = kinds_.sensor.make(choice, context);
    if (!sensor) return sensor.error();
    auto mounted = unpacked(choice.kind, std::move(sensor).value());
    for (sensory::SensorSuite::Part& part : mounted) {
      of_kind[part.kind] = context.instance + 1;
      const bool payload = part.sensor->payload();
      context.has_camera |= part.sensor->finds_objects();
      context.has_fire_sensor |= part.sensor->senses_fire();
      context.finds_aircraft |= part.sensor->finds_aircraft();
      (payload ? parts.payload : parts.sensors).push_back(part.kind);
      (payload ? vehicle.payload : vehicle.sensors).push_back(std::move(part.sensor));
    }
  }
  if (links_.world) {  // that is what the payload looks at
    vehicle.payload.clear();
    vehicle.payload.push_back(
        std::make_unique<world_link::ReceivedPayload>(*links_.world));
  }
  return parts;
}

}  // namespace skein::assemble
