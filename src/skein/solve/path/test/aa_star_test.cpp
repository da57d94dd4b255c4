// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/aa_star.h"

#include <gtest/gtest.h>

#include "skein/base/math.h"
#include "skein/base/random.h"
#include "skein/model/connection/connection.h"
#include "skein/solve/path/lower_bound.h"
#include "skein/solve/path/test/oracle.h"
#include "skein/solve/path/test/scenes.h"

namespace skein::solve::aa_star_test {
namespace {

PathQuery query_over(double distance) {
  PathQuery q;
  q.start = {Vec3(0, 0, -100), 0};
  q.goal = {Vec3(distance, 0, -100), 0};
  q.budget.expansions = 30'000;
  return q;
}

class Plain final : public Terrain {
 public:
  explicit Plain(double ridge = 0) : ridge_(ridge) {}
  double elevation_msl(const Vec2& p) const override {
    return std::max(0.0, ridge_ - 0.5 * std::abs(p.x() - 1500));
  }
  Vec2 gradient(const Vec2&) const override { return {0, 0}; }

 private:
  double ridge_;
};

// What every path has to be, by a check that shares nothing with the planner.
void expect_valid(const PathQuery& q, const PlannedPath& path) {
  ASSERT_FALSE(path.plan.empty()) << name_of(path.outcome) << " " << path.reason;
  EXPECT_LT(test::gaps(path.plan), 1e-6);
  const FlightElement& first = path.plan.front();
  EXPECT_LT((first.p_N - q.start.p_N).norm(), 1e-9);
  EXPECT_DOUBLE_EQ(first.start, q.start_time);
  const model::FlightMoment end = model::end_of(path.plan.back());
  // A millionth of the turn radius.
  EXPECT_LT((end.p_N - q.goal.p_N).norm(), 1e-6 * q.limits.turn_radius);
  EXPECT_NEAR(geo::wrap_pi(end.heading - q.goal.heading), 0, 1e-6);
  EXPECT_NEAR(path.duration, model::duration(path.plan), 1e-9);
  EXPECT_LE(path.bound, path.duration);
  if (q.airspace != nullptr) {
    EXPECT_LE(test::depth(*q.airspace, path.plan, 0.05), 0.1);
  }
  if (q.limits.climb_acceleration > 0) {
    EXPECT_LT(test::climb_jump(path.plan), 1e-6);
  }
  const double rate = q.limits.airspeed / q.limits.turn_radius;
  for (const FlightElement& e : path.plan) {
    EXPECT_LE(std::abs(e.turn_rate), rate * (1 + 1e-9));
    EXPECT_LE(e.climb_rate, q.limits.climb_rate * (1 + 1e-9));
    EXPECT_GE(e.climb_rate, -q.limits.sink_rate * (1 + 1e-9));
    EXPECT_LE(std::abs(e.climb_acceleration), q.limits.climb_acceleration * (1 + 1e-9));
    EXPECT_EQ(e.airspeed, q.limits.airspeed);
    EXPECT_EQ(e.wind, q.wind);
    for (int i = 0; i <= 100; ++i) {
      const Vec3 p = model::position(e, e.duration * i / 100);
      EXPECT_GE(p.x(), q.south_west.x() - 0.1);
      EXPECT_LE(p.y(), q.north_east.y() + 0.1);
      if (q.terrain != nullptr) {
        EXPECT_GE(-p.z() - q.terrain->elevation_msl(geo::horizontal(p)),
                  q.ground_clearance - 0.1);
      }
    }
  }
}

struct Known {
  double best, sampling;
};
// The best paths known, and those of a sampling planner (BIT*) after 10 s [m].
const std::map<std::string, Known> kScenes = {{"sparse10", {2578.36, 2655}},
                                              {"dense50", {2586.36, 2621}},
                                              {"wall", {2683.77, 2693}}};

TEST(AaStar, IsAsShortAsTheBestKnownPathsOfTheScenes) {
  auto scenes = test::read_scenes(test::scenes_file());
  if (scenes.empty()) GTEST_SKIP() << "no " << test::scenes_file();
  for (test::Scene& s : scenes) {
    s.link();
    const Known known = kScenes.at(s.name);
    const PlannedPath path = AaStar().plan(s.query);
    expect_valid(s.query, path);
    EXPECT_EQ(path.outcome, PlanningOutcome::kFound);
    const double length = path.duration * s.query.limits.airspeed;
    // Margins of 0.02 m around discs, and the last digit of the known lengths.
    EXPECT_NEAR(length, known.best, 0.05) << s.name;
    EXPECT_LE(path.bound * s.query.limits.airspeed, known.best + 0.01);
    s.query.budget.first = true;
    expect_valid(s.query, AaStar().plan(s.query));
  }
}

// The same by manoeuvres alone, without the routes around discs.
TEST(AaStar, ManoeuvresAloneComeNearTheTangents) {
  auto scenes = test::read_scenes(test::scenes_file());
  if (scenes.empty()) GTEST_SKIP() << "no " << test::scenes_file();
  for (test::Scene& s : scenes) {
    s.link();
    s.query.budget.expansions = 30'000;
    const PlannedPath path = AaStar({.detours = false}).plan(s.query);
    expect_valid(s.query, path);
    EXPECT_LE(path.duration * s.query.limits.airspeed, kScenes.at(s.name).sampling);
    EXPECT_GE(path.duration * s.query.limits.airspeed, kScenes.at(s.name).best - 0.2);
  }
}

TEST(AaStar, FindsValidPathsOfTheScenesInWind) {
  auto scenes = test::read_scenes(test::scenes_file());
  if (scenes.empty()) GTEST_SKIP() << "no " << test::scenes_file();
  for (test::Scene& s : scenes)
    for (const Vec2& wind : {Vec2(5, 0), Vec2(0, -10), Vec2(-9, 4)}) {
      s.link();
      s.query.wind = wind;
      s.query.budget.expansions = 20'000;
      const PlannedPath path = AaStar().plan(s.query);
      expect_valid(s.query, path);
      // The bound is of a point that turns at once; turning costs little here.
      EXPECT_LE(path.duration, 1.03 * path.bound) << s.name << " " << wind.transpose();
    }
}

TEST(AaStar, GivesTheSameAnswerAgain) {
  Airspace airspace;
  airspace.zones.push_back({Disc{Vec2(700, 30), 200}});
  airspace.zones.push_back(
      {geo::Ring{Vec2(1200, -300), Vec2(1500, 100), Vec2(1200, 200)}});
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  q.wind = Vec2(3, -6);
  const PlannedPath a = AaStar().plan(q), b = AaStar().plan(q);
  expect_valid(q, a);
  EXPECT_EQ(a.expansions, b.expansions);
  ASSERT_EQ(a.plan.size(), b.plan.size());
  for (std::size_t i = 0; i < a.plan.size(); ++i) {
    EXPECT_EQ(a.plan[i].duration, b.plan[i].duration);
    EXPECT_EQ(a.plan[i].p_N, b.plan[i].p_N);
  }
}

TEST(AaStar, CallsTheFirstPathNoMoreThanThat) {
  Airspace airspace;
  airspace.zones.push_back({Disc{Vec2(700, 30), 200}});
  airspace.zones.push_back({Disc{Vec2(1400, -50), 250}});
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  q.wind = Vec2(3, -6);
  q.budget.first = true;
  const PlannedPath path = AaStar().plan(q);
  expect_valid(q, path);
  EXPECT_GT(path.duration, 1.001 * path.bound);
  EXPECT_EQ(path.outcome, PlanningOutcome::kBudgetEnded);
}

// A start or a goal at the rim of a disc has no tangents to it.
TEST(AaStar, GoesAroundADiscAtWhoseRimItBegins) {
  for (const Vec2& wind : {Vec2(0, 0), Vec2(4, -3)}) {
    Airspace airspace;
    airspace.zones.push_back({Disc{Vec2(0, 150), 150}});
    PathQuery q = query_over(0);
    q.goal.p_N.y() = 900;
    q.start.heading = -0.5;  // away from it
    q.airspace = &airspace;
    q.wind = wind;
    for (const bool back : {false, true}) {
      SCOPED_TRACE(back);
      const PlannedPath path = AaStar().plan(q);
      expect_valid(q, path);
      EXPECT_NE(path.outcome, PlanningOutcome::kNoPath);
      SearchBudget budget(q.budget);
      EXPECT_LT(lower_bound(q, budget).time, path.duration);
      std::swap(q.start, q.goal);
      q.goal.heading = 0.5;
    }
  }
}

TEST(AaStar, TakesTheFreeConnectionWhereThereAreNoObstacles) {
  PathQuery q = query_over(800);
  q.wind = Vec2(-4, 8);
  const PlannedPath path = AaStar().plan(q);
  expect_valid(q, path);
  EXPECT_EQ(path.outcome, PlanningOutcome::kFound);
  const model::Connection c =
      model::connect({Vec2(0, 0), 0}, {Vec2(800, 0), 0}, {20, 60, q.wind});
  EXPECT_DOUBLE_EQ(path.duration, c.time);
}

TEST(AaStar, GoesAroundPolygonsAndSmallDiscs) {
  Airspace airspace;
  airspace.zones.push_back(
      {geo::Ring{Vec2(600, -200), Vec2(900, -200), Vec2(900, 300), Vec2(600, 300)}});
  airspace.zones.push_back({Disc{Vec2(1300, 0), 15}});
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  const PlannedPath path = AaStar().plan(q);
  expect_valid(q, path);
  EXPECT_LE(path.duration, 1.01 * path.bound);
}

TEST(AaStar, FliesOverARidgeWithinItsClimb) {
  const Plain ridge(400);
  PathQuery q = query_over(3000);
  q.terrain = &ridge;
  q.ground_clearance = 50;
  // Up to 450 m at 3 m/s and down again, also with vertical turns.
  for (const double acceleration : {0.0, 1.0}) {
    SCOPED_TRACE(acceleration);
    q.limits.climb_acceleration = acceleration;
    const PlannedPath path = AaStar().plan(q);
    expect_valid(q, path);
    EXPECT_GE(path.duration, 2 * 350 / 3.0 - 1);
    EXPECT_LE(path.duration, 1.15 * 2 * 350 / 3.0);
  }
}

TEST(AaStar, PassesUnderAZoneWithAFloor) {
  Airspace airspace;
  airspace.zones.push_back({geo::Ring{Vec2(900, -5000), Vec2(1100, -5000),
                                      Vec2(1100, 5000), Vec2(900, 5000)}});
  airspace.zones.back().floor_msl = 80;
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  for (const double acceleration : {0.0, 0.5, 2.0}) {
    SCOPED_TRACE(acceleration);
    q.limits.climb_acceleration = acceleration;
    const PlannedPath path = AaStar().plan(q);
    expect_valid(q, path);
    EXPECT_LE(path.duration, 101);  // 100 s straight on, sinking costs nothing
  }
}

TEST(AaStar, WaitsForAZoneToEndOrGoesAround) {
  // A wall that is there until 200 s, wider than going around takes.
  Airspace airspace;
  airspace.zones.push_back({geo::Ring{Vec2(900, -9000), Vec2(1100, -9000),
                                      Vec2(1100, 9000), Vec2(900, 9000)}});
  airspace.zones.back().until = 200;
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  const PlannedPath path = AaStar().plan(q);
  expect_valid(q, path);
  EXPECT_GE(path.duration, 255 - 0.1);  // 1100 m before the goal at 200 s, at the best
  EXPECT_LE(path.duration, 262);
  // A small one is passed sooner than it ends.
  airspace.zones.front().area = Disc{Vec2(1000, 0), 150};
  const PlannedPath around = AaStar().plan(q);
  expect_valid(q, around);
  EXPECT_LE(around.duration, 105);
}

TEST(AaStar, LetsWhatMovesAndFliesPass) {
  Airspace airspace;
  MovingObstacle m;
  m.time = 50;
  m.p_N = Vec3(1000, 0, -100);
  m.v_N = Vec3(0, 12, 0);
  m.radius = 120;
  airspace.movers.push_back(m);
  PlannedFlight f;
  f.plan.push_back({0, 200, Vec3(1500, -1500, -100), geo::kPi / 2, 20, 0, 0, Vec2(0, 0)});
  airspace.flights.push_back(f);
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  const PlannedPath path = AaStar().plan(q);
  expect_valid(q, path);
  EXPECT_LE(path.duration, 110);
}

TEST(AaStar, ReachesAGoalThatIsFreeLater) {
  Airspace airspace;
  airspace.zones.push_back({Disc{Vec2(2000, 0), 100}});
  airspace.zones.back().until = 300;
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  const PlannedPath path = AaStar().plan(q);
  expect_valid(q, path);
  EXPECT_GE(path.duration, 300);
  EXPECT_LE(path.duration, 315);
}

TEST(AaStar, NamesWhatIsWrong) {
  Airspace airspace;
  airspace.zones.push_back({Disc{Vec2(0, 30), 100}});
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  PlannedPath path = AaStar().plan(q);
  EXPECT_EQ(path.outcome, PlanningOutcome::kStartBlocked);
  ASSERT_TRUE(path.alternative);
  EXPECT_NEAR((geo::horizontal(path.alternative->p_N) - Vec2(0, 30)).norm(), 100, 0.1);
  airspace.zones.front().area = Disc{Vec2(1990, 0), 100};
  path = AaStar().plan(q);
  EXPECT_EQ(path.outcome, PlanningOutcome::kGoalBlocked);
  EXPECT_TRUE(path.alternative);
  EXPECT_NE(path.reason.find("zone 0"), std::string::npos) << path.reason;
  airspace.zones.clear();

  PathQuery bad = q;
  bad.wind = Vec2(20, 0);
  EXPECT_EQ(AaStar().plan(bad).outcome, PlanningOutcome::kWindTooStrong);
  bad = q;
  bad.goal.p_N.x() = std::nan("");
  EXPECT_EQ(AaStar().plan(bad).outcome, PlanningOutcome::kBadQuery);
  bad = q;
  bad.limits.turn_radius = 0;
  EXPECT_EQ(AaStar().plan(bad).outcome, PlanningOutcome::kBadQuery);
  bad = q;
  bad.north_east = Vec2(1000, 1000);
  path = AaStar().plan(bad);
  EXPECT_EQ(path.outcome, PlanningOutcome::kOutsideMap);
  ASSERT_TRUE(path.alternative);
  EXPECT_EQ(path.alternative->p_N.x(), 1000);
  const Plain hill(400);
  bad = q;
  bad.goal.p_N = Vec3(1500, 0, -100);
  bad.terrain = &hill;
  EXPECT_EQ(AaStar().plan(bad).outcome, PlanningOutcome::kGoalBlocked);
  EXPECT_EQ(AaStar().plan(query_over(0)).outcome, PlanningOutcome::kFound);
}

TEST(AaStar, NamesBadZones) {
  Airspace airspace;
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  const auto outcome = [&](const Zone& zone) {
    airspace.zones = {zone};
    const PlannedPath path = AaStar().plan(q);
    EXPECT_FALSE(path.reason.empty());
    return path.outcome;
  };
  const geo::Ring bow = {Vec2(500, 0), Vec2(600, 100), Vec2(600, 0), Vec2(500, 100)};
  EXPECT_EQ(outcome({bow}), PlanningOutcome::kBadQuery);
  const geo::Ring reversed = {Vec2(500, 0), Vec2(500, 100), Vec2(600, 0)};
  EXPECT_EQ(outcome({reversed}), PlanningOutcome::kBadQuery);
  EXPECT_EQ(outcome({geo::Ring{}}), PlanningOutcome::kBadQuery);
  EXPECT_EQ(outcome({Disc{Vec2(500, 0), 0}}), PlanningOutcome::kBadQuery);
  EXPECT_EQ(outcome({Disc{Vec2(500, math::kInfinity), 10}}), PlanningOutcome::kBadQuery);
  Zone inverted{Disc{Vec2(500, 0), 10}};
  inverted.floor_msl = 10;
  inverted.ceiling_msl = 0;
  EXPECT_EQ(outcome(inverted), PlanningOutcome::kBadQuery);
}

TEST(AaStar, KnowsThatAGoalIsWalledIn) {
  Airspace airspace;
  const auto wall = [&](double x0, double y0, double x1, double y1) {
    airspace.zones.push_back(
        {geo::Ring{Vec2(x0, y0), Vec2(x1, y0), Vec2(x1, y1), Vec2(x0, y1)}});
  };
  wall(1500, -500, 1600, 500);
  wall(2400, -500, 2500, 500);
  wall(1500, -500, 2500, -400);
  wall(1500, 400, 2500, 500);
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  const PlannedPath path = AaStar().plan(q);
  EXPECT_EQ(path.outcome, PlanningOutcome::kNoPath) << path.reason;
  EXPECT_FALSE(path.reason.empty());
}

TEST(AaStar, FindsAPathAmongThousandsOfZones) {
  constexpr int kRow = 50;
  Airspace airspace;
  for (int i = 0; i < kRow; ++i)
    for (int k = 0; k < kRow; ++k) {
      const Vec2 p(200.0 * i + (k % 2) * 100, 200.0 * k);
      if (k % 3 == 0) {
        airspace.zones.push_back({Disc{p, 70}});
      } else {
        airspace.zones.push_back({geo::Ring{p + Vec2(-60, -60), p + Vec2(60, -60),
                                            p + Vec2(60, 60), p + Vec2(-60, 60)}});
      }
    }
  PathQuery q = query_over(9700);
  q.airspace = &airspace;
  q.start.p_N = Vec3(100, -200, -100);
  q.goal.p_N = Vec3(9700, 9900, -100);
  q.wind = Vec2(3, 5);
  q.budget.first = true;
  const PlannedPath path = AaStar().plan(q);
  ASSERT_FALSE(path.plan.empty()) << path.reason;
  EXPECT_LE(test::depth(airspace, path.plan, 0.2), 0.1);
  // The bound may be that without zones, and this is the first path only.
  EXPECT_LE(path.duration, 1.4 * path.bound);
}

// Five walls across the path, each with one gap at a drawn place.
Airspace walls_with_gaps(double gap, RandomStream& draw) {
  Airspace airspace;
  for (int i = 0; i < 5; ++i) {
    const double north = 300 * (i + 1), middle = draw.uniform(-300, 300);
    const auto wall = [&](double west, double east) {
      airspace.zones.push_back({geo::Ring{
          {north, west}, {north + 10, west}, {north + 10, east}, {north, east}}});
    };
    wall(-800, middle - gap / 2);
    wall(middle + gap / 2, 800);
  }
  return airspace;
}

TEST(AaStar, ALimitOfTimeNeverCostsTheFirstPath) {
  RandomStream draw(17, 0, Purpose::kTest);
  for (int k = 0; k < 20; ++k) {
    const Airspace airspace = walls_with_gaps(12, draw);
    PathQuery q = query_over(1800);
    q.airspace = &airspace;
    q.south_west = {-500, -800};
    q.north_east = {2300, 800};
    q.limits.turn_radius = 60;
    q.wind = k % 2 == 0 ? Vec2(0, 0) : Vec2(draw.uniform(-5, 5), draw.uniform(-5, 5));
    q.budget.expansions = std::numeric_limits<std::int64_t>::max();
    q.budget.enough = [] { return true; };  // the time has passed already
    const PlannedPath path = AaStar().plan(q);
    SCOPED_TRACE(k);
    expect_valid(q, path);
    EXPECT_EQ(path.outcome, PlanningOutcome::kBudgetEnded);
    EXPECT_LT(path.expansions, 20'000);
    // Whoever does not want an answer any more gets none.
    q.budget.stop = [] { return true; };
    EXPECT_TRUE(AaStar().plan(q).plan.empty());
  }
}

TEST(AaStar, ALimitOfTimeEndsTheSearchForAPathThatIsNotThere) {
  // Gaps that nothing flies through in this wind, but not closed.
  RandomStream draw(18, 0, Purpose::kTest);
  const Airspace airspace = walls_with_gaps(0.05, draw);
  PathQuery q = query_over(1800);
  q.airspace = &airspace;
  q.south_west = {-500, -800};
  q.north_east = {2300, 800};
  q.wind = {3, 4};
  q.budget.expansions = std::numeric_limits<std::int64_t>::max();
  q.budget.first_expansions = 5000;
  q.budget.enough = [] { return true; };
  const PlannedPath path = AaStar().plan(q);
  EXPECT_EQ(path.outcome, PlanningOutcome::kNothingFound);
  EXPECT_LT(path.expansions, 20'000);
}

TEST(AaStar, SaysWhenTheBudgetEndsBeforeAPath) {
  Airspace airspace;
  for (int i = -20; i <= 20; ++i)
    airspace.zones.push_back({Disc{Vec2(1000, 180.0 * i), 89}});
  PathQuery q = query_over(2000);
  q.airspace = &airspace;
  q.budget.expansions = 5;
  EXPECT_EQ(AaStar().plan(q).outcome, PlanningOutcome::kNothingFound);
}

}  // namespace
}  // namespace skein::solve::aa_star_test
