// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/repair.h"

#include <gtest/gtest.h>

#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/aa_star.h"
#include "skein/solve/path/test/oracle.h"
#include "skein/solve/path/test/scenes.h"

namespace skein::solve::repair_test {
namespace {

// The query of an aircraft that has followed a plan until `time`.
PathQuery at_time(PathQuery q, const FlightPlan& plan, double time) {
  const model::FlightMoment m = model::moment_at(plan, time);
  q.start = {m.p_N, m.heading};
  q.start_time = time;
  return q;
}

void expect_valid(const PathQuery& q, const RepairedPath& r) {
  ASSERT_FALSE(r.path.plan.empty()) << r.path.reason;
  EXPECT_LT(test::gaps(r.path.plan), 1e-6);
  EXPECT_LE(test::depth(*q.airspace, r.path.plan, 0.05), 0.1);
  EXPECT_LT((r.path.plan.front().p_N - q.start.p_N).norm(), 1e-6);
  EXPECT_LT((model::end_of(r.path.plan.back()).p_N - q.goal.p_N).norm(), 1e-4);
  EXPECT_NEAR(r.path.duration, model::duration(r.path.plan), 1e-6);
}

struct Flown {
  Airspace airspace;
  PathQuery query;
  FlightPlan plan;
};

void fly(Flown& f, const Vec2& wind) {
  f.airspace.zones.push_back({Disc{Vec2(800, 20), 150}});
  f.query.airspace = &f.airspace;
  f.query.start = {Vec3(0, 0, -100), 0};
  f.query.goal = {Vec3(3000, 0, -100), 0};
  f.query.wind = wind;
  f.query.budget.expansions = 5000;
  f.plan = AaStar().plan(f.query).plan;
}

TEST(Repair, KeepsAPlanThatIsFree) {
  Flown f;
  fly(f, Vec2(3, 4));
  const PathQuery q = at_time(f.query, f.plan, 30);
  const RepairedPath r = repair(f.plan, q);
  EXPECT_EQ(r.how, Repair::kKept);
  expect_valid(q, r);
  EXPECT_NEAR(30 + r.path.duration, model::end_time_of(f.plan), 1e-9);
}

TEST(Repair, RejoinsBehindANewZone) {
  for (const Vec2& wind : {Vec2(0, 0), Vec2(-6, 5)}) {
    Flown f;
    fly(f, wind);
    const Vec3 at = model::moment_at(f.plan, 95).p_N;
    f.airspace.zones.push_back({Disc{geo::horizontal(at), 100}});
    const PathQuery q = at_time(f.query, f.plan, 30);
    const RepairedPath r = repair(f.plan, q);
    EXPECT_EQ(r.how, Repair::kRejoined) << r.reason;
    EXPECT_NE(r.reason.find("zone 1"), std::string::npos) << r.reason;
    expect_valid(q, r);
    EXPECT_LE(r.path.duration, 1.05 * r.path.bound);
    EXPECT_LT(r.left_at, r.joined_at);
  }
}

TEST(Repair, LeadsAnAircraftBackThatLeftItsPlan) {
  Flown f;
  fly(f, Vec2(0, 5));
  PathQuery q = at_time(f.query, f.plan, 70);
  q.start.p_N.y() += 120;
  q.start.heading += 0.8;
  const RepairedPath r = repair(f.plan, q);
  EXPECT_NE(r.how, Repair::kFailed);
  EXPECT_NE(r.how, Repair::kKept);
  expect_valid(q, r);
}

TEST(Repair, PlansAnewWhereRejoiningIsFarWorse) {
  // The old plan goes through a gap that is closed; the detour is elsewhere.
  Flown f;
  f.airspace.zones.push_back(
      {geo::Ring{Vec2(1000, 100), Vec2(1100, 100), Vec2(1100, 900), Vec2(1000, 900)}});
  f.airspace.zones.push_back({geo::Ring{Vec2(1000, -2500), Vec2(1100, -2500),
                                        Vec2(1100, -100), Vec2(1000, -100)}});
  f.query.airspace = &f.airspace;
  f.query.start = {Vec3(0, 0, -100), 0};
  f.query.goal = {Vec3(2000, 0, -100), 0};
  f.plan = AaStar().plan(f.query).plan;
  ASSERT_FALSE(f.plan.empty());
  f.airspace.zones.push_back(
      {geo::Ring{Vec2(1000, -100), Vec2(1100, -100), Vec2(1100, 100), Vec2(1000, 100)}});
  const PathQuery q = at_time(f.query, f.plan, 1);
  const RepairedPath r = repair(f.plan, q);
  expect_valid(q, r);
  EXPECT_LE(r.path.duration, 1.05 * r.path.bound);
}

TEST(Repair, SaysThatTheGoalIsBlockedNow) {
  Flown f;
  fly(f, Vec2(0, 0));
  f.airspace.zones.push_back({Disc{Vec2(3000, 0), 100}});
  const PathQuery q = at_time(f.query, f.plan, 30);
  const RepairedPath r = repair(f.plan, q);
  EXPECT_EQ(r.how, Repair::kFailed);
  EXPECT_EQ(r.path.outcome, PlanningOutcome::kGoalBlocked);
}

TEST(Repair, CutsPlansExactly) {
  Flown f;
  fly(f, Vec2(-4, 2));
  f.plan = model::climbing(f.plan, -100, model::quickest_climb(120, 2, 0.1));
  const FlightPlan part = part_of(f.plan, 12.5, 60.25);
  EXPECT_DOUBLE_EQ(model::start_of(part), 12.5);
  EXPECT_NEAR(model::end_time_of(part), 60.25, 1e-12);
  for (double t = 13; t < 60; t += 3.7)
    EXPECT_LT((model::moment_at(part, t).p_N - model::moment_at(f.plan, t).p_N).norm(),
              1e-9);
}

// The scenes of the speed goal: a zone appears on the middle of the path.
TEST(Repair, FindsAPathAroundANewZoneInTheScenes) {
  auto scenes = test::read_scenes(test::scenes_file());
  if (scenes.empty()) GTEST_SKIP() << "no " << test::scenes_file();
  for (test::Scene& s : scenes) {
    s.link();
    const PlannedPath path = AaStar().plan(s.query);
    ASSERT_FALSE(path.plan.empty());
    const Vec3 at = model::moment_at(path.plan, path.duration / 2).p_N;
    s.airspace.zones.push_back({Disc{geo::horizontal(at), 70}});
    const PathQuery q = at_time(s.query, path.plan, 5);
    const RepairedPath r = repair(path.plan, q);
    expect_valid(q, r);
    EXPECT_LE(r.path.duration, 1.05 * r.path.bound) << s.name;
  }
}

}  // namespace
}  // namespace skein::solve::repair_test
