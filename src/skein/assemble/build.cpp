#include "skein/assemble/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/assemble/aircraft_builder.h"
#include "skein/assemble/aircraft_fit.h"
#include "skein/assemble/kinds_of.h"
#include "skein/assemble/sampling.h"
#include "skein/data/command_text.h"
#include "skein/geo/polygon.h"
#include "skein/layer/environment/terrain/synthetic_terrain.h"
#include "skein/layer/environment/wind/uniform_wind.h"
#include "skein/layer/reasoning/agent/heartbeat.h"
#include "skein/layer/reasoning/agent/operator_orders.h"
#include "skein/layer/reasoning/agent/zone_server.h"
#include "skein/role/radio.h"
#include "skein/scenario/zones.h"
#include "skein/simulation/commanded_wind.h"

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

simulation::RunOptions run_options(const Scenario& scenario,
                                   const scenario::KindTable& kinds) {
  simulation::RunOptions options;
  options.step = scenario.step;
  options.duration = scenario.duration;
  options.environment_period = truth_period(scenario, kinds);
  const double steps_per_row = 1 / (scenario.record.rate_hz * options.step.seconds());
  options.record_period = options.step * std::llround(steps_per_row);
  options.perimeter_period = scenario.record.metrics_period;
  return options;
}

// All errors as one.
Error together(const std::vector<Error>& errors) {
  if (errors.size() == 1) return errors.front();
  Error all{errors.front().code, "", fmt::format("{} problems:", errors.size()), ""};
  for (const Error& error : errors) all.message += "\n  " + error.text();
  return all;
}

// Builds the parts of a world one after the other. What fails is replaced by something
// plain until the end, so that all errors are found at once.
class Builder {
 public:
  Builder(const Scenario& scenario, const KindRegistry& kinds, geo::LocalFrame frame)
      : scenario_(scenario), kinds_(kinds), frame_(std::move(frame)) {
    const scenario::Environment& environment = scenario.environment;
    for (std::size_t i = 0; i < environment.zone_rings.size(); ++i)
      zones_.push_back(scenario::ring_zone(environment.zone_rings[i], i));
    for (const scenario::NoFlightZone& zone : environment.zones)
      if (zone.active) zones_.push_back(scenario::to_zone(zone));
  }

  Result<Build> build() {
    build_.options = run_options(scenario_, kinds_.table());
    build_.options.commands = commands();
    build_.warnings = sampling_warnings(scenario_, kinds_.table());
    for (std::string& warning : scenario::zone_warnings(scenario_.environment))
      build_.warnings.push_back(std::move(warning));
    if (team().empty())
      build_.warnings.emplace_back(
          "no aircraft: nothing is flown, and nobody watches the fire. Give aircraft a "
          "group with a count above 0.");
    build_.world.zones = zones_;
    environment();
    note(station());
    aircraft();
    objects();
    note(radio());
    if (!errors_.empty()) return together(errors_);
    return std::move(build_);
  }

 private:
  template <class T>
  bool note(const Result<T>& made) {
    if (!made) errors_.push_back(made.error());
    return made.ok();
  }

  void environment() {
    EnvironmentContext context{frame_,  scenario_.start_utc, scenario_.seed, nullptr,
                               nullptr, &build_.warnings};
    auto terrain = kinds_.kinds().terrain.make(scenario_.environment.terrain, context);
    // Far below everything where the real one is missing: nothing collides with it.
    if (note(terrain))
      map_ = std::move(terrain).value();
    else
      map_ = std::make_shared<environment::FlatTerrain>(
          environment::FlatTerrainOptions{-1e5});
    build_.world.terrain = std::make_unique<SharedTerrain>(map_);
    context.terrain = map_.get();
    auto wind = kinds_.kinds().wind.make(scenario_.environment.wind, context);
    build_.world.wind = std::make_unique<simulation::CommandedWind>(
        note(wind) ? std::move(wind).value()
                   : std::make_unique<environment::UniformWind>(
                         environment::UniformWindOptions{}));
    context.wind = build_.world.wind.get();
    auto fire = kinds_.kinds().fire.make(scenario_.environment.fire, context);
    if (note(fire)) build_.world.fire = std::move(fire).value();
  }

  Result<void> station() {
    StationContext context{scenario_, kinds_.kinds(), team(), zones_};
    auto agent = kinds_.kinds().station_agent.make(scenario_.station.agent, context);
    if (!agent) return agent.error();
    simulation::Entity entity;
    entity.name = "station";
    entity.kind = "station";
    entity.agent = std::move(agent).value();
    entity.agent = std::make_unique<reasoning::ZoneServer>(server_options(),
                                                           std::move(entity.agent));
    entity.agent = std::make_unique<reasoning::OperatorOrders>(named_team(),
                                                               std::move(entity.agent));
    if (const Time period = heartbeat(scenario_); period > Time())
      entity.agent = std::make_unique<reasoning::HeartbeatSender>(std::move(entity.agent),
                                                                  context.team, period);
    entity.agent_period = scenario_.station.agent_period;
    entity.active = {{Time(), scenario_.duration + Time::from_ns(1)}};
    build_.world.entities.push_back(std::move(entity));
    return {};
  }

  // What the scenario commands by itself.
  std::vector<CommandRecord> commands() const {
    std::vector<CommandRecord> all;
    for (const scenario::NoFlightZone& zone : scenario_.environment.zones)
      for (const scenario::ZoneSwitch& change : zone.switches)
        all.push_back(
            {change.at, "scenario", ZoneChange{0, change.on, scenario::to_zone(zone)}});
    for (const scenario::PlannedCommand& planned : scenario_.commands)
      if (auto command = parse_command(planned.text))
        all.push_back({planned.at, "scenario", std::move(command).value()});
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
    return all;
  }

  // Who says which zones are in force.
  reasoning::ZoneServerOptions server_options() const {
    reasoning::ZoneServerOptions options;
    options.team = team();
    options.known = options.drawn = zones_;
    for (const scenario::NoFlightZone& described : scenario_.environment.zones) {
      const Zone zone = scenario::to_zone(described);
      if (!described.active) options.drawn.push_back(zone);
    }
    return options;
  }

  std::vector<reasoning::NamedAircraft> named_team() const {
    const std::vector<EntityId> ids = team();
    std::vector<reasoning::NamedAircraft> all;
    for (const std::vector<std::string>& group : aircraft_names(scenario_))
      for (const std::string& name : group) all.push_back({ids[all.size()], name});
    return all;
  }

  std::vector<EntityId> team() const {
    std::vector<EntityId> all;
    std::uint32_t next = kStation.value + 1;
    for (const AircraftGroup& group : scenario_.aircraft)
      for (int i = 0; i < group.count; ++i) all.push_back(EntityId{next++});
    return all;
  }

  void aircraft() {
    AircraftBuilder builder(scenario_, kinds_.kinds(), map_, zones_, *build_.world.wind,
                            kStation);
    for (const AircraftGroup& group : scenario_.aircraft)
      for (int i = 0; i < group.count; ++i) {
        auto made = builder.make(
            group, i, EntityId{static_cast<std::uint32_t>(build_.world.entities.size())});
        if (!note(made)) break;  // the others of its group are alike
        if (!note_fit(group, i, made.value())) break;
        build_.world.entities.push_back(std::move(made).value());
      }
  }

  bool note_fit(const AircraftGroup& group, int index,
                const simulation::Entity& aircraft) {
    const std::vector<Error> found =
        incompatibilities(scenario_, kinds_, group, aircraft);
    errors_.insert(errors_.end(), found.begin(), found.end());
    if (index == 0)
      for (const std::string& warning : warnings(scenario_, group, aircraft))
        build_.warnings.push_back(warning);
    return found.empty();
  }

  void objects() {
    std::uint32_t id = 0;
    for (const scenario::PlacedObject& object : scenario_.environment.objects)
      build_.world.objects.push_back(
          {id++, object.name, object.position, object.velocity});
  }

  Result<void> radio() {
    // The radio outlives no entity: both are the world's.
    RadioContext context;
    context.seed = scenario_.seed;
    std::vector<const Vehicle*> vehicles;
    for (const simulation::Entity& entity : build_.world.entities)
      vehicles.push_back(entity.vehicle.get());
    const Vec2 at = scenario_.station.position;
    const Vec3 antenna(at.x(), at.y(),
                       -(map_->elevation_msl(at) + scenario_.station.antenna_agl));
    context.position = [vehicles, antenna](EntityId id) -> std::optional<Vec3> {
      if (id == kStation) return antenna;
      if (id.value >= vehicles.size() || !vehicles[id.value]) return std::nullopt;
      // Radio waves leave from where it is, known or not.
      const VehicleState* truth = vehicles[id.value]->truth();
      return truth ? truth->p_N : vehicles[id.value]->estimate().p_N;
    };
    auto made = kinds_.kinds().radio.make(scenario_.radio, context);
    if (!made) return made.error();
    build_.world.radio = std::move(made).value();
    return {};
  }

  const Scenario& scenario_;
  const KindRegistry& kinds_;
  geo::LocalFrame frame_;
  std::vector<Zone> zones_;
  std::shared_ptr<const Terrain> map_;
  Build build_;
  std::vector<Error> errors_;
};

}  // namespace

Result<Build> build(const Scenario& scenario, const KindRegistry& kinds) {
  auto frame = geo::LocalFrame::at(scenario.origin);
  if (!frame) return frame.error();
  return Builder(scenario, kinds, std::move(frame).value()).build();
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
