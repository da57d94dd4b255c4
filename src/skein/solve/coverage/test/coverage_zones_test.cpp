// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/solve/coverage/test/coverage_checks.h"
#include "skein/solve/path/aa_star.h"
#include "skein/solve/path/test/plan_checks.h"

namespace skein::solve::coverage_zones_test {
namespace {

CoverageQuery with_zones(int i) {
  RandomStream random(static_cast<std::uint64_t>(i), 0, Purpose::kTest);
  CoverageQuery q;
  q.area = random_ring(random, 5, 0.2);
  const Vec2 middle = (q.area[0] + q.area[2]) / 2;
  q.zones = {{Disc{middle, random.uniform(40, 120)}},
             {geo::Ring{{-500, -500}, {-350, -450}, {-400, -300}}}};
  q.swath = 80;
  q.limits = {15, 30, 3, 11, 20, 3};
  q.wind = random.uniform(0, 6) * geo::unit(random.uniform(0, 6.3));
  q.aircraft[0].start = FlightState{{-900, 0, -100}, 0};
  return q;
}

// Time in zones, by another method than the planner's.
double inside_zones(const CoverageQuery& q, const FlightPlan& plan) {
  double deepest = 0;
  for (double t = 0; t < model::end_time_of(plan); t += 0.1)
    for (const Zone& z : q.zones)
      if (const Vec2 p = geo::horizontal(model::moment_at(plan, t).p_N); covers(z, p))
        deepest = std::max(deepest, -distance_from(outline(z, 0.01), p));
  return deepest;
}

TEST(CoverageZones, StaysOutWithAPlannerAndSeesTheRest) {
  const AaStar planner;
  for (int i = 0; i < 6; ++i) {
    CoverageQuery q = with_zones(i);
    q.planner = &planner;
    const CoverageResult r = plan_coverage(q);
    ASSERT_EQ(r.outcome, CoverageOutcome::kPlanned) << i << ": " << r.reason;
    expect_flyable(r.plans[0], q.limits, q.wind);
    EXPECT_EQ(missed(q, r, 17), 0) << i;
    EXPECT_NEAR(r.covered_share, 1, 1e-4) << i;
    EXPECT_LT(inside_zones(q, r.plans[0]), 0.1) << i;
    EXPECT_EQ(r.in_zones, 0) << i;
  }
}

TEST(CoverageZones, KeepsADistanceThatIsAskedForAndSeesWhatIsFurther) {
  const AaStar planner;
  for (int i = 0; i < 3; ++i) {
    CoverageQuery q = with_zones(i);
    q.planner = &planner;
    q.zone_distance = 60;
    const CoverageResult r = plan_coverage(q);
    ASSERT_EQ(r.outcome, CoverageOutcome::kPlanned) << i << ": " << r.reason;
    EXPECT_EQ(missed(q, r, 17, 60 + q.swath / 2), 0) << i;
    EXPECT_LT(r.covered_share, 0.999);
  }
}

TEST(CoverageZones, SeveralAircraftSeeTheRestToo) {
  const AaStar planner;
  CoverageQuery q = with_zones(2);
  q.planner = &planner;
  q.aircraft.push_back({FlightState{{0, -900, -100}, 0}});
  const CoverageResult r = plan_coverage(q);
  ASSERT_EQ(r.outcome, CoverageOutcome::kPlanned) << r.reason;
  ASSERT_EQ(r.plans.size(), 2);
  EXPECT_EQ(missed(q, r, 17), 0);
  for (const FlightPlan& plan : r.plans) EXPECT_LT(inside_zones(q, plan), 0.1);
}

TEST(CoverageZones, SaysSoWhenAConnectionEntersOne) {
  CoverageQuery q;
  // Two strips, and a wall between them that is too long to be flown around by chance.
  q.area = {{0, 0}, {600, 0}, {600, 600}, {0, 600}};
  q.zones = {{geo::Ring{{-3000, 250}, {3000, 250}, {3000, 350}, {-3000, 350}}}};
  q.limits = {15, 30, 3, 11, 20, 3};
  const CoverageResult r = plan_coverage(q);
  EXPECT_EQ(r.outcome, CoverageOutcome::kZoneInTheWay);
  EXPECT_NEAR(r.in_zones, 100 / 15.0, 2);
  EXPECT_FALSE(r.reason.empty());
}

TEST(CoverageZones, RefusesAStartOrEndInsideOfOne) {
  CoverageQuery q = with_zones(1);
  const Disc disc = std::get<Disc>(q.zones[0].area);
  const Vec2 inside = disc.centre + Vec2(disc.radius / 2, 0);
  const FlightState blocked{{inside.x(), inside.y(), -100}, 0};
  q.aircraft[0].start = blocked;
  const CoverageResult r = plan_coverage(q);
  EXPECT_EQ(r.outcome, CoverageOutcome::kBlocked);
  EXPECT_NE(r.reason.find("start of aircraft 0"), std::string::npos) << r.reason;
  ASSERT_TRUE(r.free_place);
  for (const Zone& zone : q.zones) EXPECT_FALSE(covers(zone, *r.free_place));
  EXPECT_LT((*r.free_place - inside).norm(), disc.radius / 2 + 2);
  q.aircraft[0] = {std::nullopt, blocked};
  EXPECT_EQ(plan_coverage(q).outcome, CoverageOutcome::kBlocked);
  // Above the zone nothing blocks it, and one that comes later does not hold yet.
  q.zones[0].ceiling_msl = 50;
  EXPECT_NE(plan_coverage(q).outcome, CoverageOutcome::kBlocked);
  q.zones[0].ceiling_msl = 1e9;
  q.zones[0].from = 1000;
  q.aircraft[0] = {blocked, std::nullopt};
  EXPECT_NE(plan_coverage(q).outcome, CoverageOutcome::kBlocked);
}

// A zone beside a strip to survey, on the path to it.
CoverageQuery with_zone_on_the_way(const Zone& zone) {
  CoverageQuery q;
  q.area = {{0, 0}, {0, 1000}, {800, 1000}, {800, 0}};
  q.zones = {zone};
  q.swath = 80;
  q.limits = {15, 30, 3, 11, 20, 3};
  q.aircraft[0].start = FlightState{{-600, 0, 0}, 0};
  return q;
}

TEST(CoverageZones, ConnectionsKeepOutAtTheirOwnAltitudesAndTimes) {
  const AaStar planner;
  const geo::Ring ring = {{-400, -300}, {-200, -300}, {-200, 300}, {-400, 300}};
  const double always = std::numeric_limits<double>::infinity();
  const std::vector<Zone> zones = {{ring, 10, 60},   // climbed through
                                   {ring, 90, 200},  // flown under
                                   {ring, -always, always, -always, 20},  // over early
                                   {ring, -always, always, 100'000}};     // begins late
  for (std::size_t k = 0; k < zones.size(); ++k) {
    CoverageQuery q = with_zone_on_the_way(zones[k]);
    q.planner = &planner;
    const CoverageResult r = plan_coverage(q);
    ASSERT_EQ(r.outcome, CoverageOutcome::kPlanned) << k << ": " << r.reason;
    EXPECT_EQ(r.in_zones, 0) << k;
    for (double t = 0; t < r.longest; t += 0.5) {
      const Vec3 p_N = model::moment_at(r.plans[0], t).p_N;
      EXPECT_FALSE(holds_at(zones[k], -p_N.z(), t) &&
                   distance_from(ring, geo::horizontal(p_N)) < -0.1)
          << k << ", " << t;
    }
  }
  // Without a planner the first one is flown through, and that is reported.
  CoverageQuery q = with_zone_on_the_way(zones[0]);
  EXPECT_EQ(plan_coverage(q).outcome, CoverageOutcome::kZoneInTheWay);
}

TEST(CoverageZones, ThoseOfOtherAltitudesAndTimesDoNotCount) {
  CoverageQuery q = with_zones(1);
  q.zones[0].ceiling_msl = 50;
  q.zones[1].until = -1;
  const CoverageResult r = plan_coverage(q);
  EXPECT_EQ(r.outcome, CoverageOutcome::kPlanned);
  EXPECT_NEAR(r.covered_share, 1, 1e-9);
}

}  // namespace
}  // namespace skein::solve::coverage_zones_test
