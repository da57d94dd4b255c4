#include "assemble/build.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "assemble/kinds_of.h"
#include "assemble/placement.h"
#include "assemble/presence.h"
#include "assemble/sampling.h"
#include "geo/clip.h"
#include "geo/polygon.h"
#include "layer/environment/terrain/synthetic_terrain.h"
#include "layer/environment/wind/uniform_wind.h"
#include "layer/reasoning/monitoring/coordinator/coordinator.h"

namespace skein::assemble {
namespace {

using scenario::AircraftGroup;
using scenario::Scenario;

constexpr EntityId kStation{0};

// Wraps a shared terrain as the world's own: agents carry it as their map.
class SharedTerrain : public Terrain {
 public:
  explicit SharedTerrain(std::shared_ptr<const Terrain> terrain)
      : terrain_(std::move(terrain)) {}
  double elevation_msl(const Vec2& p) const override {
    return terrain_->elevation_msl(p);
  }
  Vec2 gradient(const Vec2& p) const override { return terrain_->gradient(p); }

 private:
  std::shared_ptr<const Terrain> terrain_;
};

simulation::RunOptions run_options(const Scenario& scenario) {
  simulation::RunOptions options;
  options.step = scenario.step;
  options.duration = scenario.duration;
  options.environment_period = truth_period(scenario);
  const double steps_per_row = 1 / (scenario.record.rate_hz * options.step.seconds());
  options.record_period = options.step * std::llround(steps_per_row);
  options.perimeter_period = scenario.record.metrics_period;
  return options;
}

// All faults as one.
Error together(const std::vector<Error>& faults) {
  if (faults.size() == 1) return faults.front();
  Error all{faults.front().code, "", fmt::format("{} problems:", faults.size()), ""};
  for (const Error& fault : faults) all.message += "\n  " + fault.text();
  return all;
}

// Builds the parts of a world one after the other. What fails is replaced by something
// plain until the end, so that all faults are found at once.
class Builder {
 public:
  Builder(const Scenario& scenario, geo::LocalFrame frame)
      : scenario_(scenario), frame_(std::move(frame)) {
    // A zone drawn the other way round, or crossing itself, means the same area.
    const geo::Region area =
        geo::clean(scenario.environment.zones, geo::FillRule::kNonZero);
    for (const geo::Ring& ring : area)
      if (geo::signed_area(ring) > 0) zones_.push_back({ring});
  }

  Result<Build> build() {
    build_.options = run_options(scenario_);
    build_.warnings = sampling_warnings(scenario_);
    environment();
    note(station());
    for (const AircraftGroup& group : scenario_.aircraft)
      for (int i = 0; i < group.count; ++i)
        if (!note(aircraft(group, i))) break;  // the others of its group are alike
    note(radio());
    if (!faults_.empty()) return together(faults_);
    return std::move(build_);
  }

 private:
  template <class T>
  bool note(const Result<T>& made) {
    if (!made) faults_.push_back(made.error());
    return made.ok();
  }

  void environment() {
    EnvironmentContext context{frame_,  scenario_.start_utc, scenario_.seed, nullptr,
                               nullptr, &build_.warnings};
    auto terrain = terrain_kinds().make(scenario_.environment.terrain, context);
    // Far below everything where the real one is missing: nothing collides with it.
    if (note(terrain))
      map_ = std::move(terrain).value();
    else
      map_ = std::make_shared<environment::FlatTerrain>(
          environment::FlatTerrainOptions{-1e5});
    build_.world.terrain = std::make_unique<SharedTerrain>(map_);
    context.terrain = map_.get();
    auto wind = wind_kinds().make(scenario_.environment.wind, context);
    if (note(wind))
      build_.world.wind = std::move(wind).value();
    else
      build_.world.wind =
          std::make_unique<environment::UniformWind>(environment::UniformWindOptions{});
    context.wind = build_.world.wind.get();
    auto fire = fire_kinds().make(scenario_.environment.fire, context);
    if (note(fire)) build_.world.fire = std::move(fire).value();
  }

  Result<void> station() {
    const scenario::Monitoring& mission = scenario_.monitoring;
    auto estimator =
        estimator_kinds().make(mission.estimator, {scenario_.seed, mission.prior});
    if (!estimator) return estimator.error();
    auto strategy = strategy_kinds().make(mission.strategy, {});
    if (!strategy) return strategy.error();

    monitoring::CoordinatorOptions options;
    std::uint32_t next = kStation.value + 1;
    for (const AircraftGroup& group : scenario_.aircraft)
      for (int i = 0; i < group.count; ++i) options.team.push_back(EntityId{next++});
    options.origin = mission.prior.origin;
    options.entry_courses = mission.deployment.courses;
    options.forced_crossing = mission.forced_crossing.seconds();
    options.deployment_limit = mission.deployment.limit.seconds();
    options.lost_after = mission.lost_after.seconds();
    options.late_window = mission.late_window.seconds();
    options.zones = zones_;

    simulation::Entity entity;
    entity.name = "station";
    entity.kind = "station";
    entity.agent = std::make_unique<monitoring::Coordinator>(
        options, std::move(estimator).value(), std::move(strategy).value());
    entity.agent_period = scenario_.station.agent_period;
    entity.active = {{Time(), scenario_.duration + Time::from_ns(1)}};
    build_.world.entities.push_back(std::move(entity));
    return {};
  }

  Result<void> aircraft(const AircraftGroup& group, int index) {
    const Place place = place_at_start(group.start, index, group.count);
    const std::string name = fmt::format("{}-{}", group.name, ++named_[group.name]);
    AircraftContext context;
    context.seed = scenario_.seed;
    context.self = EntityId{static_cast<std::uint32_t>(build_.world.entities.size())};
    context.station = kStation;
    context.agent_period = group.agent_period;
    context.altitude_agl = group.altitude_agl;
    context.map = map_;
    context.zones = zones_;

    auto plant = plant_kinds().make(group.plant, context);
    if (!plant) return plant.error();
    auto vehicle = std::make_unique<simulation::Vehicle>();
    vehicle->plant = std::move(plant).value();
    vehicle->step = scenario_.step;
    context.limits = vehicle->plant->limits();
    if (auto placed = put(name, place, group, *vehicle); !placed) return placed;
    context.initial = nav_of(vehicle->state);

    auto autopilot = autopilot_kinds().make(group.autopilot, context);
    if (!autopilot) return autopilot.error();
    vehicle->autopilot = std::move(autopilot).value();
    std::map<std::string, std::uint32_t> of_kind;
    for (const scenario::Choice& choice : group.sensors) {
      context.instance = of_kind[choice.kind]++;
      auto sensor = sensor_kinds().make(choice, context);
      if (!sensor) return sensor.error();
      auto& kind = sensor.value()->payload() ? vehicle->payload : vehicle->sensors;
      kind.push_back(std::move(sensor).value());
    }
    auto agent = agent_kinds().make(group.agent, context);
    if (!agent) return agent.error();

    simulation::Entity entity;
    entity.name = name;
    entity.kind = "aircraft";
    entity.agent = std::move(agent).value();
    entity.vehicle = std::move(vehicle);
    entity.agent_period = group.agent_period;
    entity.active = presence(group, index, scenario_.duration);
    build_.world.entities.push_back(std::move(entity));
    return {};
  }

  // The state at the start: level flight at cruise, in the wind of that place.
  Result<void> put(const std::string& name, const Place& place,
                   const AircraftGroup& group, simulation::Vehicle& vehicle) {
    const double ground = map_->elevation_msl(place.position);
    const double altitude =
        group.start.altitude_msl.value_or(ground + group.altitude_agl);
    if (altitude <= ground)
      return Error{ErrorCode::kBadInput, name,
                   fmt::format("starts inside terrain: at {:.1f} m above mean sea level, "
                               "where the ground is at {:.1f} m.",
                               altitude, ground),
                   "Raise start.altitude_msl_m or leave it out."};
    VehicleStart start;
    start.p_N = {place.position.x(), place.position.y(), -altitude};
    start.heading = place.heading;
    start.wind_N = build_.world.wind->wind(start.p_N, Time());
    vehicle.state = vehicle.plant->start(start);
    vehicle.air.wind_N = start.wind_N;
    for (const Zone& zone : zones_)
      if (geo::contains(zone.ring, place.position))
        return Error{ErrorCode::kBadInput, name,
                     fmt::format("starts inside a no-flight zone, at {:.0f} m north, "
                                 "{:.0f} m east.",
                                 place.position.x(), place.position.y()),
                     "Move its start or the zone."};
    return {};
  }

  static NavEstimate nav_of(const VehicleState& state) {
    NavEstimate nav;
    nav.p_N = state.p_N;
    nav.v_N = state.v_N;
    nav.heading = geo::yaw(state.q_NB);
    return nav;
  }

  Result<void> radio() {
    // The radio outlives no entity: both are the world's.
    RadioContext context;
    context.seed = scenario_.seed;
    std::vector<const simulation::Vehicle*> vehicles;
    for (const simulation::Entity& entity : build_.world.entities)
      vehicles.push_back(entity.vehicle.get());
    const Vec2 at = scenario_.station.position;
    const Vec3 antenna(at.x(), at.y(),
                       -(map_->elevation_msl(at) + scenario_.station.antenna_agl));
    context.position = [vehicles, antenna](EntityId id) -> std::optional<Vec3> {
      if (id == kStation) return antenna;
      if (id.value >= vehicles.size() || !vehicles[id.value]) return std::nullopt;
      return vehicles[id.value]->state.p_N;
    };
    auto made = radio_kinds().make(scenario_.radio, context);
    if (!made) return made.error();
    build_.world.radio = std::move(made).value();
    return {};
  }

  const Scenario& scenario_;
  geo::LocalFrame frame_;
  std::vector<Zone> zones_;
  std::shared_ptr<const Terrain> map_;
  Build build_;
  std::vector<Error> faults_;
  std::map<std::string, int> named_;  // how many aircraft have a group's name
};

}  // namespace

Result<Build> build(const Scenario& scenario) {
  auto frame = geo::LocalFrame::at(scenario.origin);
  if (!frame) return frame.error();
  return Builder(scenario, std::move(frame).value()).build();
}

TerrainPatch sample_terrain(const Terrain& terrain, const Vec2& centre,
                            double half_size) {
  constexpr int kRows = 161;
  TerrainPatch patch;
  patch.rows = kRows;
  patch.spacing = 2 * half_size / (kRows - 1);
  patch.low = centre - Vec2::Constant(half_size);
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kRows; ++c)
      patch.heights.push_back(static_cast<float>(
          terrain.elevation_msl(patch.low + patch.spacing * Vec2(r, c))));
  return patch;
}

}  // namespace skein::assemble
