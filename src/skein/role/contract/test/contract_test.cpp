// SPDX-License-Identifier: Apache-2.0
// The suites find what they are for: each implementation here breaks one rule.
#include "skein/role/contract/contract.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "skein/base/random.h"
#include "skein/role/agent.h"
#include "skein/role/antenna.h"
#include "skein/role/autopilot.h"
#include "skein/role/error_model.h"
#include "skein/role/monitoring_strategy.h"
#include "skein/role/path_planner.h"
#include "skein/role/perimeter_estimator.h"
#include "skein/role/phenomenon.h"
#include "skein/role/plant.h"
#include "skein/role/propagation.h"
#include "skein/role/radio.h"
#include "skein/role/routing.h"
#include "skein/role/sensor.h"
#include "skein/role/terrain.h"
#include "skein/role/turbulence.h"
#include "skein/role/vehicle.h"
#include "skein/role/wind_field.h"

namespace skein::contract::contract_test {
namespace {

using One = Violations;

// --- terrain, wind, turbulence -------------------------------------------------------

struct Slope : Terrain {
  double elevation_msl(const Vec2& p) const override { return 0.1 * p.x(); }
  Vec2 gradient(const Vec2&) const override { return {0.1, 0}; }
};
struct WrongSlope final : Slope {
  Vec2 gradient(const Vec2&) const override { return {0, 0.1}; }
};
struct Abyss final : Slope {
  double elevation_msl(const Vec2& p) const override {
    return p.norm() > 1e4 ? -std::numeric_limits<double>::infinity() : 0.1 * p.x();
  }
};

template <class T, class Role = T>
Make<Role> make() {
  return [] { return std::make_unique<T>(); };
}

TEST(TerrainContract, FindsWrongSlopesAndHoles) {
  EXPECT_EQ((terrain_violations(make<Slope, Terrain>())), One{});
  EXPECT_EQ((terrain_violations(make<WrongSlope, Terrain>())),
            One{"gradient() is not the slope of elevation_msl()"});
  EXPECT_EQ((terrain_violations(make<Abyss, Terrain>())),
            One{"elevation_msl() is not finite everywhere"});
}

struct Restless final : WindField {
  Vec3 wind(const Vec3&, Time) const override { return {1.0 * ++asked, 0, 0}; }
  mutable int asked = 0;
};

TEST(WindContract, FindsAWindThatChangesWhenAsked) {
  EXPECT_EQ((wind_violations(make<Restless, WindField>())),
            One{"the same place and time has another wind when asked again"});
}

// Gusts that grow from one made to the next.
class Moody final : public Turbulence {
 public:
  explicit Moody(double mood) : mood_(mood) {}
  Gust advance(const TurbulenceView&, double) override {
    return {{mood_, 0, 0}, Vec3::Zero()};
  }

 private:
  double mood_;
};

TEST(TurbulenceContract, FindsGustsThatDifferOrAreNoNumbers) {
  double mood = 0;
  EXPECT_EQ(turbulence_violations([&] { return std::make_unique<Moody>(++mood); }),
            One{"two equal ones do not gust alike"});
  EXPECT_EQ(turbulence_violations([] {
              return std::make_unique<Moody>(std::numeric_limits<double>::infinity());
            }),
            One{"gusts are not finite"});
}

// --- phenomena -----------------------------------------------------------------------

// A square that grows, shrinks or lies elsewhere than it says.
class Square : public Phenomenon {
 public:
  explicit Square(double rate, double shift = 0) : rate_(rate), shift_(shift) {}
  void advance(Time time) override {
    half_ = 500 + rate_ * time.seconds();
    region_ = {{{half_, half_}, {-half_, half_}, {-half_, -half_}, {half_, -half_}}};
  }
  bool inside(const Vec2& p) const override {
    return (p - Vec2(shift_, 0)).lpNorm<Eigen::Infinity>() < half_;
  }
  const geo::Region& region() const override { return region_; }

 private:
  double rate_, shift_, half_ = 0;
  geo::Region region_;
};

Make<Phenomenon> square(double rate, double shift = 0) {
  return [=] { return std::make_unique<Square>(rate, shift); };
}

TEST(PhenomenonContract, FindsWhatGoesOutAndWhatLiesElsewhere) {
  EXPECT_EQ(phenomenon_violations(square(1)), One{});
  EXPECT_EQ(phenomenon_violations(square(-1)), One{"what burnt is no longer inside"});
  EXPECT_EQ(phenomenon_violations(square(1, 40)), One{"inside() and region() disagree"});
}

// --- sensors -------------------------------------------------------------------------

struct HeightFinder : Sensor {
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    out.emplace_back(HeightSample{view.now, -view.vehicle.p_N.z()});
  }
};
struct Eraser final : HeightFinder {
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    out.clear();
    HeightFinder::sample(view, out);
  }
};
struct Peeper final : HeightFinder {
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    if (inside(view.phenomena, std::nullopt, {0, 0})) HeightFinder::sample(view, out);
  }
};
struct Gambler final : HeightFinder {
  explicit Gambler(std::uint64_t seed) : random(seed, 0, Purpose::kTest) {}
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    out.emplace_back(HeightSample{view.now, random.normal()});
  }
  RandomStream random;
};

TEST(SensorContract, FindsEachBreach) {
  EXPECT_EQ((sensor_violations(make<HeightFinder, Sensor>())), One{});
  EXPECT_EQ((sensor_violations(make<Eraser, Sensor>())),
            One{"sample() changes what others have said before"});
  EXPECT_EQ((sensor_violations(make<Peeper, Sensor>())),
            One{"it looks at the fire, but payload() says that it serves the autopilot"});
  std::uint64_t seed = 0;
  EXPECT_EQ(sensor_violations([&] { return std::make_unique<Gambler>(++seed); }),
            One{"two equal ones do not say the same"});
}

// --- radio ---------------------------------------------------------------------------

// Delivers what was sent `copies` times, a step later.
class Copier final : public Radio {
 public:
  explicit Copier(int copies) : copies_(copies) {}
  void send(const Message& message) override {
    for (int k = 0; k < copies_; ++k) in_transit_.push_back(message);
  }
  void deliver(Time, RadioNews& news) override {
    for (const Message& message : in_transit_) news.ended.push_back({message});
    in_transit_.clear();
  }

 private:
  int copies_;
  std::vector<Message> in_transit_;
};

TEST(RadioContract, FindsMessagesThatVanishOrDouble) {
  const EntityId entities[] = {EntityId{0}, EntityId{1}};
  const auto copier = [](int copies) -> Make<Radio> {
    return [copies] { return std::make_unique<Copier>(copies); };
  };
  EXPECT_EQ(radio_violations(copier(1), entities), One{});
  EXPECT_EQ(radio_violations(copier(2), entities),
            (Violations{"a message comes out twice, or was never sent",
                        "when a run ends a message is not delivered, lost or pending, "
                        "once"}));
  EXPECT_EQ(radio_violations(copier(0), entities),
            (Violations{"after two minutes a message is neither delivered nor lost",
                        "when a run ends a message is not delivered, lost or pending, "
                        "once"}));
}

// --- routing -------------------------------------------------------------------------

// Sends everything to one entity.
class OneWay final : public Routing {
 public:
  explicit OneWay(EntityId way) : way_(way) {}
  std::uint32_t head_bytes() const override { return 0; }
  void learn(EntityId, EntityId, const RoutedMessage&, Time) override {}
  std::optional<EntityId> next(EntityId, const RoutedMessage&, const HeardLately&,
                               Time) override {
    return way_;
  }
  bool failed(EntityId, EntityId) override { return false; }
  double delay(EntityId) override { return 0; }

 private:
  EntityId way_;
};

TEST(RoutingContract, FindsWaysThatThereAreNot) {
  const auto one_way = [](EntityId way) -> Make<Routing> {
    return [way] { return std::make_unique<OneWay>(way); };
  };
  EXPECT_EQ(routing_violations(one_way(kEveryone)), One{});
  const Violations found = routing_violations(one_way(EntityId{2}));
  EXPECT_EQ(
      std::set<std::string>(found.begin(), found.end()),
      (std::set<std::string>{"it sends to itself",
                             "it sends by way of somebody whom the sender does not hear",
                             "a receiver that its sender hears is not reached"}));
  EXPECT_EQ(routing_violations(one_way(EntityId{1000})).front(),
            "it sends to nobody who takes part");
}

// --- parts of radios -----------------------------------------------------------------

struct Amplifier final : Propagation {
  double received(double radiated, const Vec3& from, const Vec3& to) const override {
    return radiated * (from.x() < to.x() ? 2 : -2);
  }
};

TEST(PropagationContract, FindsWhatNoFieldDoes) {
  const Violations found =
      propagation_violations([] { return std::make_unique<Amplifier>(); });
  EXPECT_EQ(std::set<std::string>(found.begin(), found.end()),
            (std::set<std::string>{"a power is below 0 or not finite",
                                   "more arrives than was sent",
                                   "a link is not the same in both directions"}));
}

struct NoGain final : Antenna {
  double gain(const Vec3& direction_B) const override { return direction_B.z(); }
};

TEST(AntennaContract, FindsGainsBelowNothing) {
  EXPECT_EQ(antenna_violations([] { return std::make_unique<NoGain>(); }),
            One{"a gain is below 0 or not finite"});
}

struct Reversed final : ErrorModel {
  double log_header_success(double, double duration) const override { return -duration; }
  double log_payload_success(double sinr, double) const override { return -sinr; }
};

TEST(ErrorModelContract, FindsModelsThatAreNone) {
  const Violations found =
      error_model_violations([] { return std::make_unique<Reversed>(); });
  EXPECT_EQ(std::set<std::string>(found.begin(), found.end()),
            (std::set<std::string>{"a better signal is understood worse",
                                   "parts of a frame do not make the whole"}));
}

// --- strategies and estimators -------------------------------------------------------

// Sends all aircraft to one place, or in the wrong order.
class Herd final : public MonitoringStrategy {
 public:
  explicit Herd(bool backwards) : backwards_(backwards) {}
  std::vector<Assignment> assign(const MonitoringSituation& situation) override {
    std::vector<Assignment> orders;
    for (const AircraftStatus& each : situation.aircraft)
      orders.push_back({each.id, FlyTo{{backwards_ ? 100.0 * each.id.value : 0, 0}}});
    if (backwards_) std::reverse(orders.begin(), orders.end());
    return orders;
  }

 private:
  bool backwards_;
};

TEST(StrategyContract, FindsEachBreach) {
  const auto herd = [](bool backwards) -> Make<MonitoringStrategy> {
    return [backwards] { return std::make_unique<Herd>(backwards); };
  };
  EXPECT_EQ(strategy_violations(herd(false)),
            One{"two aircraft are sent to the same point"});
  EXPECT_EQ(strategy_violations(herd(true)),
            One{"orders are not at most one each, in the order of the aircraft"});
}

// A circle that every observation makes larger; clones may share the radius.
class Swelling final : public PerimeterEstimator {
 public:
  explicit Swelling(bool shares) : shares_(shares) {}
  void predict(Time time) override { time_ = time; }
  void observe(const FireReading&) override { ++*radius_; }
  void observe(const Crossing&) override { ++*radius_; }
  BoundaryEstimate boundary() const override {
    BoundaryEstimate estimate{time_, {{}}};
    for (int k = 0; k < 12; ++k) {
      BoundaryPoint point;
      point.normal = geo::unit(k * geo::kPi / 6);
      point.position = *radius_ * point.normal;
      estimate.rings[0].push_back(point);
    }
    return estimate;
  }
  EstimatorHealth health() const override { return {}; }
  std::unique_ptr<PerimeterEstimator> clone() const override {
    auto copy = std::make_unique<Swelling>(*this);
    if (!shares_) copy->radius_ = std::make_shared<double>(*radius_);
    return copy;
  }

 private:
  bool shares_;
  Time time_;
  std::shared_ptr<double> radius_ = std::make_shared<double>(500);
};

TEST(EstimatorContract, FindsClonesThatAreTheOriginal) {
  const auto swelling = [](bool shares) -> Make<PerimeterEstimator> {
    return [shares] { return std::make_unique<Swelling>(shares); };
  };
  EXPECT_EQ(estimator_violations(swelling(false), {}), One{});
  const One found = estimator_violations(swelling(true), {});
  EXPECT_EQ(std::count(found.begin(), found.end(),
                       "what a clone observes changes the original"),
            1);
}

// --- plants, autopilots, agents ------------------------------------------------------

// Moves evenly; counts its steps, as no plant may.
class CountingPlant final : public Plant {
 public:
  FlightLimits limits() const override { return {}; }
  Airframe airframe() const override { return SelfStabilised{}; }
  VehicleState start(const VehicleStart& start) const override {
    VehicleState state;
    state.p_N = start.p_N;
    state.q_NB = geo::from_euler({0, 0, start.heading});
    return state;
  }
  void step(VehicleState& state, const Control&, const Air&, double dt) const override {
    state.p_N.x() += dt * ++steps_;
  }
  Contact touch(VehicleState&, double, double) const override { return Contact::kRests; }

 private:
  mutable int steps_ = 0;
};

TEST(PlantContract, FindsMemoryAndGroundContactWithoutGround) {
  EXPECT_EQ((plant_violations(make<CountingPlant, Plant>())),
            (One{"step() depends on more than the state: on other vehicles",
                 "touch() rests, but the vehicle is not on the ground"}));
}

class FullThrottle final : public Autopilot {
 public:
  void begin(const NavEstimate& start, bool) override { nav_ = start; }
  void sense(const SensorSample&) override {}
  void command(const AutopilotCommand&) override {}
  void set_return(const ReturnRoute&) override {}
  Control control(Time, double) override {
    Actuators all;
    all.channel.fill(1.5);
    return all;
  }
  NavEstimate estimate() const override { return nav_; }
  AutopilotStatus status() const override { return {}; }

 private:
  NavEstimate nav_;
};

TEST(AutopilotContract, FindsControlsOutOfRange) {
  const One found{"control() is not what the airframe takes, or not in its range"};
  EXPECT_EQ(
      (autopilot_violations(make<FullThrottle, Autopilot>(), FixedWingAirframe{}, {})),
      found);
  EXPECT_EQ((autopilot_violations(make<FullThrottle, Autopilot>(), SelfStabilised{}, {})),
            found);
}

struct Lost final : Agent {
  void step(const AgentInput&, AgentOutput& out) override {
    out.events.clear();
    out.command = AutopilotCommand{HoldCourse{std::nan("")}, 100, std::nullopt};
  }
};

TEST(AgentContract, FindsEachBreach) {
  const NavEstimate nav;
  EXPECT_EQ(
      (agent_violations(make<Lost, Agent>(), &nav)),
      (One{"step() removes what is in the output already", "a command is not finite"}));
  EXPECT_EQ((agent_violations(make<Lost, Agent>(), nullptr)),
            (One{"step() removes what is in the output already",
                 "it commands, but has no vehicle", "a command is not finite"}));
}

// --- vehicles, planners ----------------------------------------------------------------

// Each breaks one promise of a vehicle, if it is asked to.
class OddVehicle final : public Vehicle {
 public:
  enum class Breach { kNone, kFuture, kSilent, kTwice, kShy };
  explicit OddVehicle(Breach breach) : breach_(breach) {}

  void begin(const Surroundings&, Time now) override { nav_.time = now; }
  void look(const Surroundings&, Time, PayloadSamples&) override {}
  void advance(const Surroundings&, Time, Time until, const Vehicle*) override {
    nav_.time = until;
    if (breach_ == Breach::kFuture) nav_.time = until + Time::from_seconds(1);
  }
  NavEstimate estimate() const override { return nav_; }
  AutopilotStatus status() const override { return {}; }
  void command(const AutopilotCommand& command) override {
    ++fate_.number;
    const auto* course = std::get_if<HoldCourse>(&command.guidance);
    const bool flies = !course || std::isfinite(course->course);
    fate_.state = flies ? CommandFate::State::kAccepted : CommandFate::State::kRefused;
    fate_.reason = flies || breach_ == Breach::kSilent ? "" : "no course";
  }
  CommandFate command_fate() const override { return fate_; }
  void set_return(const ReturnRoute&) override {}
  void ground_received(Time) override {}
  const VehicleState* truth() const override {
    return breach_ == Breach::kShy && nav_.time.seconds() > 5 ? nullptr : &state_;
  }
  void take_events(std::vector<VehicleEvent>& out) override {
    if (breach_ == Breach::kTwice)
      out.push_back({EventLabel::named("again"), "and again"});
  }
  Result<void> set_fault(const std::string&, bool, Time) override {
    return Error{ErrorCode::kBadInput, "", "there is none", ""};
  }

 private:
  Breach breach_;
  NavEstimate nav_;
  VehicleState state_;
  CommandFate fate_;
};

TEST(VehicleContract, FindsEachBreach) {
  using Breach = OddVehicle::Breach;
  const Restless wind;
  const auto found = [&](Breach breach) {
    return vehicle_violations([=] { return std::make_unique<OddVehicle>(breach); }, wind);
  };
  EXPECT_EQ(found(Breach::kNone), One{});
  EXPECT_EQ(found(Breach::kFuture), One{"estimate() is of the future"});
  EXPECT_EQ(found(Breach::kSilent), One{"a command is refused without a reason"});
  EXPECT_EQ(found(Breach::kTwice), One{"take_events() gives an event twice"});
  EXPECT_EQ(found(Breach::kShy), One{"the truth is known at some times only"});
}

// Flies straight to the goal, whatever is between.
struct Crow final : PathPlanner {
  PlannedPath plan(const PathQuery& query) const override {
    PlannedPath path;
    const Vec2 line = geo::horizontal(query.goal.p_N - query.start.p_N);
    FlightElement straight;
    straight.start = query.start_time;
    straight.p_N = query.start.p_N;
    straight.heading = query.start.heading;
    straight.airspeed = query.limits.airspeed;
    straight.duration = line.norm() / straight.airspeed;
    straight.climb_rate = (query.start.p_N.z() - query.goal.p_N.z()) / straight.duration;
    straight.wind =
        line / straight.duration - straight.airspeed * geo::unit(straight.heading);
    path.outcome = PlanningOutcome::kFound;
    path.duration = straight.duration;
    path.plan = {straight};
    return path;
  }
};

TEST(PlannerContract, FindsEachBreach) {
  const One found = planner_violations(make<Crow, PathPlanner>());
  for (const char* rule :
       {"a plan leads through a zone", "a query without numbers is not refused",
        "it plans in wind that no aircraft can fly against",
        "a start inside a zone is not reported", "a plan's climb rate jumps",
        "a plan does not end level"})
    EXPECT_EQ(std::count(found.begin(), found.end(), rule), 1) << rule;
  EXPECT_EQ(std::count(found.begin(), found.end(), "a plan does not end at the goal"), 0);
}

}  // namespace
}  // namespace skein::contract::contract_test
