// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/route_flight.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "skein/data/airspace/airspace.h"
#include "skein/layer/reasoning/trajectory/test/test_flight.h"
#include "skein/model/path/plan_curve.h"

namespace skein::reasoning::route_flight_test {
namespace {

Zone disc(const std::string& name, const Vec2& centre, double radius) {
  Zone zone{.area = Disc{centre, radius}};
  zone.name = name;
  return zone;
}

// Goes around every zone by one corner, beside the first of them; counts its calls.
class CornerPlanner final : public PathPlanner {
 public:
  explicit CornerPlanner(const Vec2& corner) : corner_(corner) {}
  PlannedPath plan(const PathQuery& query) const override {
    ++calls;
    zones = query.airspace->zones;
    PlannedPath path;
    if (fails) {
      path.outcome = PlanningOutcome::kNoPath;
      path.reason = "as set";
      return path;
    }
    path.outcome = PlanningOutcome::kFound;
    double time = query.start_time;
    Vec3 from = query.start.p_N;
    for (const Vec2& to : {corner_, geo::horizontal(query.goal.p_N)}) {
      const Vec2 leg = to - geo::horizontal(from);
      FlightElement element;
      element.start = time;
      element.airspeed = query.limits.airspeed;
      element.duration = leg.norm() / element.airspeed;
      element.p_N = from;
      element.heading = geo::bearing(leg);
      path.plan.push_back(element);
      time += element.duration;
      from = {to.x(), to.y(), from.z()};
    }
    return path;
  }
  mutable int calls = 0;
  mutable std::vector<Zone> zones;
  bool fails = false;

 private:
  Vec2 corner_;
};

bool same_route(const AutopilotCommand& a, const AutopilotCommand& b) {
  const auto* now = std::get_if<FlyWaypoints>(&a.guidance);
  const auto* next = std::get_if<FlyWaypoints>(&b.guidance);
  return now && next && now->laps == next->laps &&
         std::equal(now->points.begin(), now->points.end(), next->points.begin(),
                    next->points.end(),
                    [](const auto& x, const auto& y) { return x.point == y.point; });
}

// An aircraft with an autopilot that flies waypoints and plans as well. As autopilots do,
// it goes on with, or has done, waypoints that it is sent again.
class Flight {
 public:
  explicit Flight(const Legs& options,
                  std::shared_ptr<const PathPlanner> planner = nullptr,
                  const std::vector<Zone>& known = {})
      : zones({}, FlightLimits{}, known, EntityId{1}),
        route(options, {EntityId{1}, FlightLimits{}, &ground_, std::move(planner)}) {}

  void hear(bool on, const Zone& zone) {
    inbox_.emplace_back().content = ZoneChange{++changes_, on, zone};
  }

  // Flies on, and notes how near it comes to `watched`.
  void fly(double seconds) {
    const double end = time_ + seconds;
    for (; time_ < end - 1e-9; time_ += 0.5) {
      think();
      for (int k = 0; k < 10; ++k) {
        steer();
        aircraft.step(0.05);
        const bool there = (aircraft.position() - visited).norm() < 60;
        visits += there && !there_;
        there_ = there;
        for (const Zone& zone : watched)
          inside = std::max(
              inside,
              std::get<Disc>(zone.area).radius -
                  (aircraft.position() - std::get<Disc>(zone.area).centre).norm());
      }
    }
  }
  bool reported(EventKind kind) const { return count(kind) > 0; }
  std::ptrdiff_t count(EventKind kind) const {
    return std::count_if(events.begin(), events.end(),
                         [&](const Event& event) { return event.kind == kind; });
  }
  std::string ending() const {
    FlightProgress progress;
    route.report(progress);
    return progress.ending;
  }
  template <class Guidance>
  bool flies() const {
    return std::holds_alternative<Guidance>(command.guidance);
  }

  test::TestAircraft aircraft;
  ZoneMonitor zones;
  RouteFlight route;
  AutopilotCommand command;
  int commands = 0;
  std::vector<Event> events;
  std::vector<Zone> watched;
  double inside = -1e9;
  bool off_plan = false, refuses_plans = false;
  int refusals = 0;
  Vec2 visited = Vec2(2000, 1000);
  int visits = 0;

 private:
  void think() {
    AgentInput in;
    in.now = Time::from_seconds(time_);
    const NavEstimate nav = aircraft.nav(in.now);
    in.nav = &nav;
    in.autopilot.done = done_;
    in.command_fate = fate_;
    in.inbox = inbox_;
    AgentOutput out;
    zones.listen(in, out);
    inbox_.clear();
    route.step({in, zones, returns_, off_plan, false}, out);
    events.insert(events.end(), out.events.begin(), out.events.end());
    if (!out.command) return;
    ++commands;
    fate_.state = CommandFate::State::kAccepted;
    if (refuses_plans && std::holds_alternative<FollowPlan>(out.command->guidance)) {
      ++refusals;
      fate_.state = CommandFate::State::kRefused;
      return;
    }
    const bool goes_on = same_route(command, *out.command);
    command = *out.command;
    if (goes_on) return;
    leg_ = 0;
    done_ = false;
  }

  // What of a command the test's aircraft does not know becomes a course.
  void steer() {
    AutopilotCommand simple = command;
    const auto towards = [&](const Vec2& to) {
      simple.guidance = HoldCourse{geo::bearing(to - aircraft.position())};
    };
    if (const auto* laps = std::get_if<FlyWaypoints>(&command.guidance)) {
      const std::size_t count = laps->points.size();
      const std::size_t all = count * static_cast<std::size_t>(laps->laps);
      if ((aircraft.position() - laps->points[leg_ % count].point).norm() < 40)
        done_ = ++leg_ >= all;
      if (done_) leg_ = all - 1;
      towards(laps->points[leg_ % count].point);
    } else if (const auto* follow = std::get_if<FollowPlan>(&command.guidance)) {
      model::PlanCurve curve;
      curve.assign(follow->plan);
      const double end = follow->plan.back().time.seconds();
      done_ = time_ >= end;
      towards(geo::horizontal(curve.at(std::min(time_ + 3, end)).p_N));
    } else if (const auto* hold = std::get_if<HoldPosition>(&command.guidance)) {
      simple.guidance = Circle{hold->point, 69, true};
    }
    aircraft.obey(simple);
  }

  test::FlatGround ground_;
  ReturnPlanner returns_{{}, FlightLimits{}, EntityId{1}, ground_};
  std::vector<Message> inbox_;
  std::uint32_t changes_ = 0;
  double time_ = 0;
  std::size_t leg_ = 0;
  CommandFate fate_;
  bool done_ = false, there_ = false;
};

Legs there_and_back() {
  Legs options;
  options.points = {{2000, 0}, {2000, 1000}, {0, 1000}};
  options.altitude_msl = 220;
  return options;
}

TEST(RouteFlight, IsOneCommandWithoutZones) {
  Legs options = there_and_back();
  options.laps = 3;
  Flight flight(options);
  flight.fly(100);
  EXPECT_EQ(flight.commands, 1);
  const auto& route = std::get<FlyWaypoints>(flight.command.guidance);
  EXPECT_EQ(route.laps, 3);
  EXPECT_EQ(route.points.size(), 3u);
  EXPECT_TRUE(flight.events.empty());
}

TEST(RouteFlight, GoesAroundAZoneThatComesOntoALegAndOn) {
  Flight flight(there_and_back());
  flight.fly(20);
  const Zone zone = disc("a", {1200, 20}, 250);
  flight.watched = {zone};
  flight.hear(true, zone);
  flight.fly(0.5);
  EXPECT_EQ(flight.commands, 2);  // within one step
  flight.fly(400);
  EXPECT_LT(flight.inside, 0);
  EXPECT_TRUE(flight.route.done());
  EXPECT_FALSE(flight.reported(EventKind::kPointLeftOut));
}

TEST(RouteFlight, LeavesWhatIsNotOnTheRouteAlone) {
  Flight flight(there_and_back());
  flight.fly(20);
  flight.hear(true, disc("a", {1000, -500}, 250));
  flight.fly(30);
  // Looked at again, and the rest of the route is free.
  EXPECT_TRUE(flight.flies<FlyWaypoints>());
  EXPECT_LE(flight.commands, 2);
}

TEST(RouteFlight, ComesBackToTheLegWhenTheZoneGoes) {
  Flight flight(there_and_back());
  flight.fly(20);
  const Zone zone = disc("a", {1200, 20}, 250);
  flight.hear(true, zone);
  flight.fly(5);
  EXPECT_TRUE(flight.flies<HoldCourse>());
  flight.hear(false, zone);
  flight.fly(0.5);
  ASSERT_TRUE(flight.flies<FlyWaypoints>());
  EXPECT_EQ(std::get<FlyWaypoints>(flight.command.guidance).points.front().point,
            Vec2(2000, 0));
}

TEST(RouteFlight, LeavesOutAPointInAZone) {
  Flight flight(there_and_back());
  flight.fly(20);
  const Zone zone = disc("a", {2000, 0}, 150);
  flight.watched = {zone};
  flight.hear(true, zone);
  flight.fly(400);
  EXPECT_TRUE(flight.reported(EventKind::kPointLeftOut));
  EXPECT_LT(flight.inside, 0);
  EXPECT_TRUE(flight.route.done());
}

TEST(RouteFlight, FliesEveryLapWithoutThePointThatIsLeftOut) {
  for (int laps : {2, 3, 4}) {
    SCOPED_TRACE(laps);
    Legs options = there_and_back();
    options.laps = laps;
    Flight flight(options);
    flight.fly(20);
    const Zone zone = disc("a", {2000, 0}, 150);
    flight.watched = {zone};
    flight.hear(true, zone);
    flight.fly(400 * laps);
    EXPECT_EQ(flight.count(EventKind::kPointLeftOut), laps);
    EXPECT_EQ(flight.visits, laps);
    EXPECT_LT(flight.inside, 0);
    EXPECT_TRUE(flight.route.done());
    EXPECT_EQ(flight.ending(), "the last point has been passed");
  }
}

TEST(RouteFlight, IsDoneWhenAllOtherPointsAreLeftOut) {
  Legs options;
  options.points = {{1000, 0}, {1500, 0}, {2000, 1000}, {1500, 0}};
  options.laps = 3;
  options.altitude_msl = 220;
  Flight flight(options);
  flight.hear(true, disc("a", {1000, 0}, 150));
  flight.hear(true, disc("b", {1500, 0}, 150));
  flight.fly(600);
  EXPECT_EQ(flight.visits, 1);
  EXPECT_TRUE(flight.route.done());
  EXPECT_EQ(flight.count(EventKind::kPointLeftOut), 3 * 3);
}

TEST(RouteFlight, DoesNotFlyTwiceInPlaceToTheOnlyPointThatRemains) {
  Legs options;
  options.points = {{2000, 0}, {2000, 1000}};
  options.laps = 5;
  options.altitude_msl = 220;
  Flight flight(options);
  flight.hear(true, disc("a", {2000, 0}, 150));
  flight.fly(300);
  EXPECT_TRUE(flight.route.done());
  EXPECT_EQ(flight.commands, 1);
  EXPECT_EQ(flight.count(EventKind::kPointLeftOut), 5);
  EXPECT_EQ(flight.ending(), "the last point has been passed");
}

TEST(RouteFlight, StaysAtALastPointBesideAZoneThatItReachesBySight) {
  Legs options;
  options.points = {{2000, 0}};
  options.altitude_msl = 220;
  Flight flight(options);
  const Zone zone = disc("a", {2000, 225}, 200);  // nearer than the margin
  flight.watched = {zone};
  flight.hear(true, zone);
  flight.fly(400);
  EXPECT_TRUE(flight.route.done());
  EXPECT_LT(flight.inside, 0);
  EXPECT_LT((flight.aircraft.position() - Vec2(2000, 0)).norm(), 400);
}

TEST(RouteFlight, ReportsOnceThatTheLastPointIsLeftOut) {
  const auto planner = std::make_shared<CornerPlanner>(Vec2(0, 0));
  planner->fails = true;
  Legs options;
  options.points = {{2000, 0}};
  options.altitude_msl = 220;
  Flight flight(options, planner);
  flight.fly(20);
  const Zone zone = disc("a", {2000, 0}, 200);
  flight.hear(true, zone);
  flight.fly(200);
  EXPECT_TRUE(flight.route.done());
  EXPECT_EQ(flight.count(EventKind::kPointLeftOut), 1);
  EXPECT_EQ(flight.count(EventKind::kNoPath), 0);
  EXPECT_NE(flight.ending().find("left out"), std::string::npos);
}

TEST(RouteFlight, FliesToTheLastPointWhenItsZoneGoes) {
  Legs options;
  options.points = {{2000, 1000}};
  options.altitude_msl = 220;
  Flight flight(options);
  const Zone zone = disc("a", {2000, 1000}, 200);
  flight.hear(true, zone);
  flight.fly(60);
  flight.hear(false, zone);
  flight.fly(200);
  EXPECT_EQ(flight.count(EventKind::kPointLeftOut), 1);
  EXPECT_GE(flight.visits, 1);
  EXPECT_EQ(flight.ending(), "the last point has been passed");
}

TEST(RouteFlight, ReportsOncePerChangeThatThereIsNoPath) {
  const auto planner = std::make_shared<CornerPlanner>(Vec2(0, 0));
  planner->fails = true;
  Flight flight(there_and_back(), planner);
  flight.hear(true, disc("a", {1200, 20}, 250));
  flight.fly(35);
  EXPECT_GE(planner->calls, 3);
  EXPECT_EQ(flight.count(EventKind::kNoPath), 1);
  flight.hear(true, disc("b", {1600, 20}, 250));
  flight.fly(5);
  EXPECT_EQ(flight.count(EventKind::kNoPath), 2);
}

TEST(RouteFlight, StaysElsewhereWhenTheLastPointLiesInAZone) {
  Flight flight(there_and_back());
  const Zone zone = disc("a", {0, 1000}, 150);
  flight.watched = {zone};
  flight.hear(true, zone);
  flight.fly(400);
  EXPECT_TRUE(flight.route.done());
  EXPECT_LT(flight.inside, 0);
  EXPECT_LT((flight.aircraft.position() - Vec2(0, 1000)).norm(), 500);
  // And moves away from one that comes over the place where it stays.
  const Zone other = disc("b", flight.aircraft.position(), 200);
  flight.hear(true, other);
  flight.fly(60);
  flight.watched = {zone, other};
  flight.inside = -1e9;
  flight.fly(200);
  EXPECT_LT(flight.inside, 0);
}

TEST(RouteFlight, LeavesAZoneThatComesOverIt) {
  Flight flight(there_and_back());
  flight.fly(20);
  const Zone zone = disc("a", flight.aircraft.position() + Vec2(100, 100), 400);
  flight.hear(true, zone);
  flight.fly(45);
  flight.watched = {zone};
  flight.inside = -1e9;
  flight.fly(300);
  EXPECT_LT(flight.inside, 0);
  EXPECT_TRUE(flight.route.done());
}

TEST(RouteFlight, IsNotConcernedByZonesAboveAndBelow) {
  Flight flight(there_and_back());
  flight.fly(20);
  Zone high = disc("a", {1200, 20}, 250), low = disc("b", {1200, 20}, 250);
  high.floor_msl = 245;
  low.ceiling_msl = 195;
  flight.hear(true, high);
  flight.hear(true, low);
  flight.fly(20);
  EXPECT_TRUE(flight.flies<FlyWaypoints>());
}

TEST(RouteFlight, FliesAPlanAroundAZoneAndThenTheRest) {
  const auto planner = std::make_shared<CornerPlanner>(Vec2(1200, -400));
  Flight flight(there_and_back(), planner);
  flight.fly(20);
  const Zone zone = disc("a", {1200, 20}, 250);
  flight.watched = {zone};
  flight.hear(true, zone);
  flight.fly(0.5);
  ASSERT_TRUE(flight.flies<FollowPlan>());
  EXPECT_TRUE(flight.reported(EventKind::kPlanned));
  // Grown by the margin.
  ASSERT_EQ(planner->zones.size(), 1u);
  EXPECT_DOUBLE_EQ(std::get<Disc>(planner->zones[0].area).radius, 280);
  flight.fly(40);
  EXPECT_EQ(planner->calls, 1);
  flight.fly(300);
  EXPECT_LT(flight.inside, 0);
  EXPECT_TRUE(flight.route.done());
  EXPECT_EQ(planner->calls, 1);
}

TEST(RouteFlight, PlansAgainWhenOffPlanAndWhenAZoneComes) {
  const auto planner = std::make_shared<CornerPlanner>(Vec2(1200, -600));
  Flight flight(there_and_back(), planner);
  flight.fly(20);
  flight.hear(true, disc("a", {1200, 20}, 250));
  flight.fly(12);
  EXPECT_EQ(planner->calls, 1);
  flight.off_plan = true;
  flight.fly(5);
  EXPECT_EQ(planner->calls, 2);  // and not at each step
  flight.off_plan = false;
  flight.hear(true, disc("b", {1600, 20}, 250));
  flight.fly(0.5);
  EXPECT_EQ(planner->calls, 3);
  EXPECT_EQ(planner->zones.size(), 2u);
}

TEST(RouteFlight, GoesAroundBySightWhenNoPathIsFound) {
  const auto planner = std::make_shared<CornerPlanner>(Vec2(0, 0));
  planner->fails = true;
  Flight flight(there_and_back(), planner);
  flight.fly(20);
  const Zone zone = disc("a", {1200, 20}, 250);
  flight.watched = {zone};
  flight.hear(true, zone);
  flight.fly(400);
  EXPECT_TRUE(flight.reported(EventKind::kNoPath));
  EXPECT_LT(flight.inside, 0);
  EXPECT_TRUE(flight.route.done());
  EXPECT_LT(planner->calls, 10);
}

TEST(RouteFlight, GoesAroundBySightWhenItsPlansAreRefused) {
  Flight flight(there_and_back(), std::make_shared<CornerPlanner>(Vec2(1200, -400)));
  flight.refuses_plans = true;
  flight.fly(20);
  const Zone zone = disc("a", {1200, 20}, 250);
  flight.watched = {zone};
  flight.hear(true, zone);
  flight.fly(400);
  EXPECT_GT(flight.refusals, 0);
  EXPECT_LT(flight.inside, 0);
  EXPECT_TRUE(flight.route.done());
}

TEST(RouteFlight, AKnownZoneBesideTheRouteLeavesItAsItWasLaid) {
  // 10 m beside the leg: nearer than the margin.
  Flight known(there_and_back(), nullptr, {disc("a", {1000, -260}, 250)});
  known.fly(40);
  EXPECT_EQ(known.commands, 1);
  Flight drawn(there_and_back());
  drawn.hear(true, disc("a", {1000, -260}, 250));
  drawn.fly(5);
  EXPECT_TRUE(drawn.flies<HoldCourse>());
}

}  // namespace
}  // namespace skein::reasoning::route_flight_test
