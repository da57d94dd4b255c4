// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/verify_kinds.h"

#include <fmt/format.h>

#include <array>

#include "skein/assemble/radio/radio_fields.h"
#include "skein/assemble/radio/radio_file.h"
#include "skein/assemble/world/build.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/environment/terrain/synthetic_terrain.h"
#include "skein/layer/environment/wind/uniform_wind.h"
#include "skein/layer/reasoning/agent/onboard_agent.h"
#include "skein/layer/reasoning/station/mission_control.h"
#include "skein/layer/reasoning/team/onboard/team_server.h"
#include "skein/role/agent.h"
#include "skein/role/antenna.h"
#include "skein/role/autopilot.h"
#include "skein/role/error_model.h"
#include "skein/role/monitoring_strategy.h"
#include "skein/role/moving_object.h"
#include "skein/role/perimeter_estimator.h"
#include "skein/role/phenomenon.h"
#include "skein/role/plant.h"
#include "skein/role/propagation.h"
#include "skein/role/radio.h"
#include "skein/role/routing.h"
#include "skein/role/sensor.h"
#include "skein/role/traffic_aircraft.h"
#include "skein/role/turbulence.h"
#include "skein/role/vehicle.h"
#include "skein/scenario/scenario_file.h"
#include "skein/solve/path/aa_star.h"

namespace skein::assemble {
namespace {

constexpr std::uint64_t kSeed = 7;

// A kind with its default options, for making as many equal ones as a suite wants.
template <class Role, class Context>
struct Subject {
  const Kinds<Role, Context>& kinds;
  scenario::Choice choice;
  Context context;

  // Fails as the kind itself: then there is nothing to test.
  Result<void> can_be_made() const {
    const auto made = kinds.make(choice, context);
    if (!made) return made.error();
    if (!made.value())
      return Error{ErrorCode::kNotFound, "", "it is nothing at all.", ""};
    return {};
  }
  contract::Make<Role> make() const {
    return [this] { return std::move(kinds.make(choice, context)).value(); };
  }
};

// The small world that kinds are made for.
class Stage {
 public:
  explicit Stage(const KindRegistry& kinds) : kinds_(kinds) {
    const auto read =
        scenario::read_scenario_text("name: contract", "contract", ".", kinds.table());
    SKEIN_CHECK(read.ok(), read.report());
    scenario_ = *read.scenario;
    for (const scenario::Kind& kind : kinds.table().of("plant")) {
      auto plant = kinds.kinds().plant.make({kind.name, kind.options->prototype},
                                            aircraft(nullptr));
      if (plant) plants_.emplace_back(kind.name, std::move(plant).value());
    }
  }

  KindVerdict verdict(const std::string& role, const scenario::Kind& kind) const;

 private:
  template <class Role>
  Subject<Role, EnvironmentContext> subject(const Kinds<Role, EnvironmentContext>& kinds,
                                            const scenario::Choice& choice) const {
    return {kinds, choice,
            EnvironmentContext{frame_, scenario_.start_utc, kSeed, &ground_, &wind_,
                               &warnings_}};
  }
  template <class Role>
  Subject<Role, AircraftContext> subject(const Kinds<Role, AircraftContext>& kinds,
                                         const scenario::Choice& choice) const {
    return {kinds, choice, aircraft(plants_.front().second.get())};
  }

  // With the plant, if there is one yet.
  AircraftContext aircraft(const Plant* plant) const {
    AircraftContext context;
    context.seed = kSeed;
    context.self = EntityId{1};
    context.station = EntityId{0};
    context.agent_period = Time::from_seconds(0.5);
    context.altitude_agl = 120;
    context.map =
        std::make_shared<environment::FlatTerrain>(environment::FlatTerrainOptions{});
    context.planner = std::make_shared<solve::AaStar>();
    context.tasks = std::make_shared<const TaskKinds>(kinds_.kinds().task);
    if (plant) context.limits = plant->limits();
    if (plant) context.airframe = plant->airframe();
    context.initial = start(context.limits);
    context.has_position = true;
    context.shared = &shared_;
    return context;
  }
  MissionContext missions() const {
    MissionContext context{kSeed, kinds_.kinds(), {}, zones_, {}, {}, {}, {}};
    // A desk of its own for each mission that is compared.
    const auto desk = [] {
      return std::make_shared<reasoning::TeamServer>(reasoning::TeamServerOptions{});
    };
    context.stations = {{EntityId{0}, "station", {}, desk}};
    for (std::uint32_t k = 1; k <= 2; ++k)
      context.stations.front().team.push_back(
          {EntityId{k}, fmt::format("scout-{}", k), "scout", {}, true, true});
    context.planner = std::make_shared<solve::AaStar>();
    context.metrics_period = Time::from_seconds(5);
    return context;
  }
  TrafficContext traffic() const {
    return {kSeed,
            frame_,
            scenario_.start_utc,
            "traffic",
            3,
            0,
            1,
            Vec3(50, 80, -300),
            [](const std::string&) { return std::optional(EntityId{1}); },
            &warnings_};
  }
  RadioContext radio() const {
    RadioContext context{kSeed, 3,
                         [](EntityId id) -> std::optional<Vec3> {
                           return Vec3(200.0 * id.value, 0, -100);
                         },
                         [](EntityId id) { return std::to_string(id.value); }};
    context.kinds = &kinds_.kinds();
    return context;
  }

  static NavEstimate start(const FlightLimits& limits) {
    NavEstimate nav;
    nav.p_N = {-800, 0, -120};
    nav.v_N = {limits.airspeed, 0, 0};
    return nav;
  }

  KindVerdict autopilot_verdict(const scenario::Kind& kind) const;
  KindVerdict vehicle_verdict(const scenario::Kind& kind) const;
  KindVerdict task_verdict(const scenario::Kind& kind) const;
  auto agent_suite(bool has_vehicle) const {
    return [this, has_vehicle](const contract::Make<Agent>& make) {
      const NavEstimate nav = start(plants_.front().second->limits());
      return contract::agent_violations(make, has_vehicle ? &nav : nullptr);
    };
  }
  static auto estimator_suite() {
    return [](const contract::Make<PerimeterEstimator>& make) {
      return contract::estimator_violations(make, PerimeterPrior());
    };
  }
  static auto radio_suite() {
    return [](const contract::Make<Radio>& make) {
      static constexpr std::array kEntities = {EntityId{0}, EntityId{1}, EntityId{2}};
      return contract::radio_violations(make, kEntities);
    };
  }

  const KindRegistry& kinds_;
  scenario::Scenario scenario_;
  geo::LocalFrame frame_ = geo::LocalFrame::at({36.989, -122.0514, 0}).value();
  environment::FlatTerrain ground_{environment::FlatTerrainOptions{}};
  environment::UniformWind wind_{environment::UniformWindOptions{}};
  std::vector<Zone> zones_;
  std::vector<std::pair<std::string, std::unique_ptr<Plant>>> plants_;  // by kind
  mutable std::vector<std::string> warnings_;
  mutable std::any shared_;
};

// With every plant that it can fly.
KindVerdict Stage::autopilot_verdict(const scenario::Kind& kind) const {
  KindVerdict verdict{"autopilot", kind.name, "it flies no plant.", {}};
  for (const auto& [name, plant] : plants_) {
    std::any shared;  // of autopilots of one kind on one plant
    AircraftContext context = aircraft(plant.get());
    context.shared = &shared;
    const Subject<Autopilot, AircraftContext> subject{
        kinds_.kinds().autopilot, {kind.name, kind.options->prototype}, context};
    if (!subject.can_be_made()) continue;
    verdict.not_tested.clear();
    for (const std::string& violation : contract::autopilot_violations(
             subject.make(), plant->airframe(), plant->limits()))
      verdict.violations.push_back(fmt::format("on the plant {}: {}", name, violation));
  }
  return verdict;
}

// As the only aircraft of a small world.
KindVerdict Stage::vehicle_verdict(const scenario::Kind& kind) const {
  KindVerdict verdict{"vehicle", kind.name, "", {}};
  const auto read = scenario::read_scenario_text(
      fmt::format("name: contract\nmissions: [formation]\n"
                  "aircraft: [{{vehicle: {}, agent: wingman}}]\n",
                  kind.name),
      "contract", ".", kinds_.table());
  if (!read.ok()) {
    verdict.not_tested = read.report();
    return verdict;
  }
  std::vector<Build> builds;  // outlive their vehicles
  const contract::Make<Vehicle> make = [&]() -> std::unique_ptr<Vehicle> {
    auto built = build(*read.scenario, kinds_);
    if (!built) {
      verdict.not_tested = built.error().text();
      return nullptr;
    }
    builds.push_back(std::move(built).value());
    return std::move(builds.back().world.entities.back().vehicle);
  };
  if (const auto one = make(); one && one->real_time())
    verdict.not_tested = "it needs somebody at the far end of its link.";
  if (verdict.not_tested.empty())
    verdict.violations = contract::vehicle_violations(make, wind_);
  return verdict;
}

// Of the task as it is when nothing is said, on board of an agent that flies nothing
// else.
KindVerdict Stage::task_verdict(const scenario::Kind& kind) const {
  KindVerdict verdict{"task", kind.name, "", {}};
  const AircraftContext context = aircraft(plants_.front().second.get());
  const TaskKinds& tasks = *context.tasks;
  reasoning::OnboardAgentOptions options;
  options.takes_orders = false;
  options.first_task = tasks.forms()->find(kind.name)->plain;
  const reasoning::FlightContext flown{context.self, context.limits, context.map.get(),
                                       context.planner, context.altitude_agl};
  TaskOptions with;
  with.has_camera = true;
  if (const auto made = tasks.make(*options.first_task, {flown, with}); !made) {
    verdict.not_tested = made.error().text();
    return verdict;
  }
  verdict.violations = agent_suite(true)([&]() -> std::unique_ptr<Agent> {
    return std::make_unique<reasoning::OnboardAgent>(
        options, context.station, flown, zones_,
        [&](const TaskKind& task, const reasoning::FlightContext& how) {
          return tasks.make(task, {how, with});
        });
  });
  return verdict;
}

KindVerdict Stage::verdict(const std::string& role, const scenario::Kind& kind) const {
  const scenario::Choice choice =
      scenario::default_choice(kinds_.table(), role, kind.name);
  const KindsByRole& all = kinds_.kinds();
  KindVerdict verdict{role, kind.name, "there is no suite for its role.", {}};
  const auto test = [&verdict](const auto& subject, auto suite) {
    const auto made = subject.can_be_made();
    verdict.not_tested = made ? "" : made.error().text();
    if (made) verdict.violations = suite(subject.make());
  };
  if (role == "terrain") test(subject(all.terrain, choice), contract::terrain_violations);
  if (role == "wind") test(subject(all.wind, choice), contract::wind_violations);
  if (role == "phenomenon")
    test(subject(all.phenomenon, choice), contract::phenomenon_violations);
  if (role == "movement")
    test(Subject<MovingObject, ObjectContext>{all.movement, choice, {kSeed, 3, {50, 80}}},
         contract::moving_object_violations);
  if (role == "traffic")
    test(Subject<TrafficAircraft, TrafficContext>{all.traffic, choice, traffic()},
         contract::traffic_violations);
  if (role == "turbulence")
    test(subject(all.turbulence, choice), contract::turbulence_violations);
  if (role == "plant") test(subject(all.plant, choice), contract::plant_violations);
  if (role == "autopilot") return autopilot_verdict(kind);
  if (role == "vehicle") return vehicle_verdict(kind);
  if (role == "task") return task_verdict(kind);
  if (role == "sensor") test(subject(all.sensor, choice), contract::sensor_violations);
  if (role == "agent") test(subject(all.agent, choice), agent_suite(true));
  if (role == "mission")
    test(Subject<reasoning::PlannedMission, MissionContext>{all.mission, choice,
                                                            missions()},
         [this](const contract::Make<reasoning::PlannedMission>& make) {
           return agent_suite(false)(
               [make] { return std::unique_ptr<Agent>(std::move(make()->mission)); });
         });
  if (role == "radio")
    test(Subject<Radio, RadioContext>{all.radio, choice, radio()}, radio_suite());
  if (role == "routing")
    test(
        Subject<Routing, RoutingContext>{
            all.routing, choice, {kSeed, contract::kRoutingEntities}},
        contract::routing_violations);
  const RadioFile radio_file;
  if (role == "propagation")
    test(Subject<Propagation, PropagationContext>{all.propagation,
                                                  choice,
                                                  {kSeed, radio_file.radio.phy.frequency,
                                                   radio_file.propagation.section,
                                                   &ground_}},
         contract::propagation_violations);
  if (role == "antenna")
    test(
        Subject<Antenna, AntennaContext>{
            all.antenna, choice, {radio_file.antenna.section}},
        contract::antenna_violations);
  if (role == "error-model")
    test(
        Subject<ErrorModel, ErrorModelContext>{all.error_model, choice,
                                               error_model_context(radio_file.radio.phy)},
        contract::error_model_violations);
  if (role == "estimator")
    test(
        Subject<PerimeterEstimator, EstimatorContext>{
            all.estimator, choice, {kSeed, PerimeterPrior()}},
        estimator_suite());
  if (role == "planner")
    test(Subject<PathPlanner, PlannerContext>{all.planner, choice, {}},
         contract::planner_violations);
  if (role == "strategy")
    test(Subject<MonitoringStrategy, StrategyContext>{all.strategy, choice, {}},
         contract::strategy_violations);
  return verdict;
}

}  // namespace

std::vector<KindVerdict> verify_kinds(const KindRegistry& kinds, const std::string& role,
                                      bool of_plugins) {
  const Stage stage(kinds);
  std::vector<KindVerdict> verdicts;
  for (const std::string& each : kinds.table().roles()) {
    if (!role.empty() && each != role) continue;
    for (const scenario::Kind& kind : kinds.table().of(each))
      if (!of_plugins || !kinds.plugin_of(each, kind.name).empty())
        verdicts.push_back(stage.verdict(each, kind));
  }
  return verdicts;
}

}  // namespace skein::assemble
