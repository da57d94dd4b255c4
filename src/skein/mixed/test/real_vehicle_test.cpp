// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/real_vehicle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "skein/base/math.h"

namespace skein::mixed::real_vehicle_test {
namespace {

// A far end whose reports and requests are the test's.
struct Script {
  std::vector<VehicleReport> says;
  std::vector<VehicleRequest> hears;
  template <class T>
  std::vector<T> all() const {
    std::vector<T> found;
    for (const VehicleRequest& request : hears)
      if (const auto* one = std::get_if<T>(&request)) found.push_back(*one);
    return found;
  }
};
class ScriptedPort final : public VehiclePort {
 public:
  explicit ScriptedPort(Script& script) : script_(script) {}
  void receive(Time, std::vector<VehicleReport>& out) override {
    for (VehicleReport& report : script_.says) out.push_back(std::move(report));
    script_.says.clear();
  }
  void send(std::uint32_t, const VehicleRequest& request) override {
    script_.hears.push_back(request);
  }

 private:
  Script& script_;
};

struct NoGuidance final : Autopilot {
  void begin(const NavEstimate&, bool) override {}
  void sense(const SensorSample&) override {}
  void command(const AutopilotCommand&) override {}
  void set_return(const ReturnRoute&) override {}
  Control control(Time, double) override { return TrackSetpoint{}; }
  NavEstimate estimate() const override { return {}; }
  AutopilotStatus status() const override { return {}; }
};

// Says whether the fire is under the vehicle, at each step.
struct FireBelow final : Sensor {
  bool payload() const override { return true; }
  bool senses_fire() const override { return true; }
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    const Vec2 place = geo::horizontal(view.vehicle.p_N);
    out.emplace_back(FireSample{view.now, 0, inside(view.phenomena, {}, place)});
  }
};

// Burns north of the origin.
struct NorthernFire final : Phenomenon {
  void advance(Time) override {}
  bool inside(const Vec2& p) const override { return p.x() > 0; }
  const geo::Region& region() const override { return region_; }
  geo::Region region_;
};

// A wall that crosses the way 80 m north of the origin.
struct Wall final : Terrain {
  double elevation_msl(const Vec2& p) const override { return p.x() > 80 ? 500 : 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};
struct Calm final : WindField {
  Vec3 wind(const Vec3&, Time) const override { return Vec3::Zero(); }
};

struct Flight {
  explicit Flight(VirtualFeedOptions feeds = {}) {
    RealVehicleParts parts;
    parts.name = "real-1";
    parts.port = std::make_unique<ScriptedPort>(script);
    parts.guidance = std::make_unique<NoGuidance>();
    parts.payload.push_back(std::make_unique<FireBelow>());
    parts.limits.slowest = 0;
    parts.limits.fastest = 1000;  // tests put it where they want it
    parts.feeds = std::move(feeds);
    vehicle = std::make_unique<RealVehicle>(std::move(parts));
    // A step before the first: in one it takes in once.
    vehicle->begin(world, Time::from_seconds(-0.1));
    script.says.emplace_back(LinkChange{LinkChange::Kind::kUp, {}});
    condition.on_ground = false;
    condition.position = true;
  }

  void says_it_is_at(double north) {
    VehicleMotion motion;
    motion.time = now;
    motion.p_N = {north, 0, -100};
    script.says.emplace_back(condition);
    script.says.emplace_back(motion);
  }
  // One step; returns what the fire sensor says.
  std::vector<bool> step() {
    vehicle->begin_step(now);
    PayloadSamples seen;
    vehicle->look(world, now, seen);
    EXPECT_EQ(seen.ends.size(), 1u);
    const Time next = now + Time::from_seconds(0.1);
    vehicle->advance(world, now, next, nullptr);
    now = next;
    std::vector<bool> readings;
    for (const SensorSample& sample : seen.samples)
      readings.push_back(std::get<FireSample>(sample).inside);
    return readings;
  }
  void run(double seconds) {
    for (int k = 0; k < 10 * seconds; ++k) {
      says_it_is_at(0);
      step();
    }
  }

  Script script;
  VehicleCondition condition;
  Wall terrain;
  Calm wind;
  NorthernFire fire;
  const Phenomenon* phenomena[1] = {&fire};
  Surroundings world{terrain, wind, phenomena, {}};
  std::unique_ptr<RealVehicle> vehicle;
  Time now;
};

TEST(RealVehicle, WhatHoversIsLedAboveItsLandingPointBeforeItComesDown) {
  Flight flight;
  flight.condition.armed = true;
  flight.condition.mode = VehicleMode::kGuided;
  flight.run(1);
  AutopilotCommand command;
  command.guidance = Land{{50, 0}, 0, {}};
  flight.vehicle->command(command);
  flight.run(2);
  EXPECT_TRUE(flight.script.all<LandRequest>().empty()) << "it is 50 m away";
  EXPECT_FALSE(flight.script.all<TrackSetpoint>().empty());
  EXPECT_FALSE(flight.vehicle->status().done);
  for (int k = 0; k < 10; ++k) {
    flight.says_it_is_at(50.5);
    flight.step();
  }
  ASSERT_FALSE(flight.script.all<LandRequest>().empty());
  EXPECT_EQ(flight.script.all<LandRequest>().front().point, Vec2(50, 0));
}

TEST(RealVehicle, SensesAFireWhereItSaysItIs) {
  Flight flight;
  EXPECT_TRUE(flight.step().empty());  // nobody knows where it is
  flight.says_it_is_at(-50);
  EXPECT_EQ(flight.step(), std::vector{false});
  flight.says_it_is_at(50);
  EXPECT_EQ(flight.step(), std::vector{true});
}

TEST(RealVehicle, SensesNothingWhenItsPositionIsOld) {
  Flight flight;
  flight.says_it_is_at(50);
  int readings = 0;
  for (int k = 0; k < 100; ++k) readings += static_cast<int>(flight.step().size());
  EXPECT_EQ(readings, 51);  // steps at which the position is up to 5 s old
  std::vector<VehicleEvent> events;
  flight.vehicle->take_events(events);
  EXPECT_EQ(std::count_if(
                events.begin(), events.end(),
                [](const VehicleEvent& e) { return e.kind == EventKind::kPositionOld; }),
            1);
  flight.says_it_is_at(50);
  EXPECT_EQ(flight.step(), std::vector{true});  // heard again
}

TEST(RealVehicle, SensesNothingMoreWhenItsLinkFails) {
  Flight flight;
  flight.says_it_is_at(50);
  EXPECT_EQ(flight.step().size(), 1u);
  ASSERT_TRUE(flight.vehicle->set_fault("link", true, flight.now).ok());
  for (int k = 0; k < 60; ++k) {
    flight.says_it_is_at(50);
    flight.step();
  }
  EXPECT_TRUE(flight.step().empty());
}

TEST(RealVehicle, IsToldOfNothingThatIsNotAskedFor) {
  Flight flight;
  flight.run(10);
  EXPECT_TRUE(flight.script.all<ObstacleDistances>().empty());
  EXPECT_TRUE(flight.script.all<FenceUpload>().empty());
  EXPECT_TRUE(flight.script.all<PositionFix>().empty());
}

TEST(RealVehicle, IsToldOfObstaclesAtTheRateAskedForAndInTheAir) {
  VirtualFeedOptions feeds;
  feeds.obstacles = ObstacleFeed{};
  Flight flight(feeds);
  flight.run(10);
  const auto seen = flight.script.all<ObstacleDistances>();
  EXPECT_EQ(seen.size(), 50u);
  EXPECT_NEAR(seen.back().distances[0], 80, 0.01);  // it looks north
  flight.condition.on_ground = true;
  flight.run(10);
  EXPECT_EQ(flight.script.all<ObstacleDistances>().size(), seen.size());
  flight.condition.on_ground = false;
  flight.run(1);
  const std::size_t before = flight.script.all<ObstacleDistances>().size();
  EXPECT_GT(before, seen.size());
  for (int k = 0; k < 60; ++k) flight.step();  // silent: none once the position is old
  const std::size_t after = flight.script.all<ObstacleDistances>().size();
  for (int k = 0; k < 60; ++k) flight.step();
  EXPECT_EQ(flight.script.all<ObstacleDistances>().size(), after);
}

TEST(RealVehicle, NoFlyZonesInForceBecomeItsFenceAndWalls) {
  VirtualFeedOptions feeds;
  feeds.fence = true;
  feeds.obstacles = ObstacleFeed{.zones = true};
  feeds.zones = {Zone{.area = Disc{{0, 50}, 10}}};
  Flight flight(feeds);
  flight.run(1);
  ASSERT_EQ(flight.script.all<FenceUpload>().size(), 1u);
  EXPECT_NEAR(flight.script.all<ObstacleDistances>().back().distances[18], 40, 1e-6);
  flight.script.says.emplace_back(
      RequestAnswer{0x8000'0001, RequestAnswer::Outcome::kAccepted, {}});
  flight.run(6);
  flight.vehicle->set_zones({});
  flight.run(1);
  const auto fences = flight.script.all<FenceUpload>();
  ASSERT_EQ(fences.size(), 2u);
  EXPECT_TRUE(fences.back().zones.empty());
  EXPECT_GT(flight.script.all<ObstacleDistances>().back().distances[18], 1e9);
}

// In the air, guided, and led.
Flight led() {
  Flight flight;
  flight.condition.armed = true;
  flight.condition.mode = VehicleMode::kGuided;
  flight.condition.mode_name = "GUIDED";
  flight.run(1);
  AutopilotCommand command;
  command.guidance = HoldPosition{{50, 0}};
  flight.vehicle->command(command);
  flight.run(2);
  EXPECT_FALSE(flight.script.all<TrackSetpoint>().empty());
  flight.script.hears.clear();
  return flight;
}

TEST(RealVehicle, AFailsafeOfItsOwnIsAFailsafeWithItsReason) {
  Flight flight = led();
  flight.script.says.emplace_back(VehicleText{4, "Battery 1 is critical 9.41V"});
  flight.condition.mode = VehicleMode::kReturn;
  flight.condition.mode_name = "RTL";
  flight.run(5);
  const AutopilotStatus status = flight.vehicle->status();
  EXPECT_EQ(status.trigger, FailsafeTrigger::kBattery);
  EXPECT_EQ(status.reaction, FailsafeReaction::kReturn);
  EXPECT_NE(status.held.find("Battery 1 is critical"), std::string::npos);
  EXPECT_FALSE(obeys_orders(status));
  EXPECT_TRUE(flight.script.hears.empty()) << "nobody commands it";
  ASSERT_TRUE(flight.vehicle->hand_back(flight.now).ok());
  flight.run(1);
  EXPECT_EQ(flight.script.all<ModeRequest>().size(), 1u);
  EXPECT_TRUE(flight.vehicle->status().held.empty());
}

TEST(RealVehicle, WithoutAPositionItIsLedNowhere) {
  Flight flight = led();
  flight.condition.position = false;
  flight.run(10);
  EXPECT_TRUE(flight.script.hears.empty());
  EXPECT_FALSE(obeys_orders(flight.vehicle->status()));
  EXPECT_EQ(flight.vehicle->status().trigger, FailsafeTrigger::kNone);
  flight.condition.position = true;
  flight.run(3);
  EXPECT_FALSE(flight.script.all<TrackSetpoint>().empty());
  EXPECT_TRUE(obeys_orders(flight.vehicle->status()));
  std::vector<VehicleEvent> events;
  flight.vehicle->take_events(events);
  const auto count = [&](EventKind kind) {
    return std::ranges::count(events, kind, &VehicleEvent::kind);
  };
  EXPECT_EQ(count(EventKind::kPositionLost), 1);
  EXPECT_EQ(count(EventKind::kPositionBack), 1);
}

// What it said meanwhile did not arrive: what counts is how it is afterwards.
TEST(RealVehicle, WhatItSaysOverALinkThatFailsIsLost) {
  Flight flight = led();
  ASSERT_TRUE(flight.vehicle->set_fault("link", true, flight.now).ok());
  flight.script.says.emplace_back(VehicleText{4, "Battery 1 is critical 9.41V"});
  flight.condition.mode = VehicleMode::kReturn;
  flight.condition.mode_name = "RTL";
  flight.run(10);
  EXPECT_FALSE(flight.vehicle->link_works());
  ASSERT_TRUE(flight.vehicle->set_fault("link", false, flight.now).ok());
  flight.run(10);
  EXPECT_TRUE(flight.vehicle->link_works());
  EXPECT_TRUE(flight.script.hears.empty()) << "its return is not undone";
  const AutopilotStatus status = flight.vehicle->status();
  EXPECT_EQ(status.trigger, FailsafeTrigger::kUnknown);
  EXPECT_NE(status.held.find("since its link was down"), std::string::npos);
}

// Is somewhere, and knows it.
struct Elsewhere final : Vehicle {
  Elsewhere() { state.p_N = {10, 20, -30}; }
  void begin(const Surroundings&, Time) override {}
  void look(const Surroundings&, Time, PayloadSamples&) override {}
  void advance(const Surroundings&, Time, Time, const Vehicle*) override {}
  NavEstimate estimate() const override { return {}; }
  AutopilotStatus status() const override { return {}; }
  void command(const AutopilotCommand&) override {}
  CommandFate command_fate() const override { return {}; }
  void set_return(const ReturnRoute&) override {}
  void ground_received(Time) override {}
  const VehicleState* truth() const override { return &state; }
  bool lost() const override { return broken; }
  void take_events(std::vector<VehicleEvent>&) override {}
  Result<void> set_fault(const std::string&, bool, Time) override { return {}; }
  VehicleState state;
  bool broken = false;
};

TEST(RealVehicle, IsGivenThePositionOfAnotherBeforeItKnowsItsOwn) {
  Elsewhere other;
  VirtualFeedOptions feeds;
  feeds.fix = FixFeed{[&] { return &other; }, 5};
  Flight flight(feeds);
  for (int k = 0; k < 100; ++k) flight.step();
  const auto fixes = flight.script.all<PositionFix>();
  EXPECT_NEAR(static_cast<double>(fixes.size()), 50, 1);
  EXPECT_EQ(fixes.back().p_N, other.state.p_N);
  other.broken = true;
  flight.run(10);
  EXPECT_EQ(flight.script.all<PositionFix>().size(), fixes.size());
}

}  // namespace
}  // namespace skein::mixed::real_vehicle_test
