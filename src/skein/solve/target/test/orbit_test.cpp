// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/orbit.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/base/random.h"
#include "skein/model/connection/connection.h"
#include "skein/solve/path/test/plan_checks.h"
#include "skein/solve/target/standoff.h"

namespace skein::solve::orbit_test {
namespace {

const FlightLimits kLimits{15, 40, 3, 11, 20, 3};

OrbitQuery around_a_point() {
  OrbitQuery q;
  q.target.at = {0, {500, 200}};
  q.limits = kLimits;
  q.start = {{0, 0, -100}, 1};
  return q;
}

// The distance to the target at a time.
double distance(const OrbitQuery& q, const OrbitResult& r, double time) {
  return (geo::horizontal(model::moment_at(r.plan, time).p_N) -
          position_at(q.target, time))
      .norm();
}

FlightLimits at_speed(double airspeed) {
  FlightLimits limits = kLimits;
  limits.airspeed = airspeed;
  limits.turn_radius = turn_radius_at(airspeed, kLimits);
  return limits;
}

TEST(Orbit, CirclesAPointInCalmAirWithOneTurnRate) {
  OrbitQuery q = around_a_point();
  const OrbitResult r = plan_orbit(q);
  ASSERT_EQ(r.outcome, OrbitOutcome::kPlanned) << r.reason;
  EXPECT_LT(r.largest_error, 1e-6);
  EXPECT_NEAR(std::abs(r.plan.back().turn_rate), 15.0 / 150, 1e-9);
  EXPECT_NEAR(model::end_time_of(r.plan), r.entry_time + 300, 1e-6);
}

TEST(Orbit, StaysOnTheCircleAroundAMovingTarget) {
  RandomStream random(5, 0, Purpose::kTest);
  for (int i = 0; i < 60; ++i) {
    OrbitQuery q = around_a_point();
    q.target.velocity = random.uniform(0, 7) * geo::unit(random.uniform(0, 6.3));
    q.wind = random.uniform(0, 7) * geo::unit(random.uniform(0, 6.3));
    q.tolerance = random.uniform(0.05, 2);
    q.altitude_msl = random.uniform(80, 130);
    const double felt = (q.wind - q.target.velocity).norm();
    q.radius = random.uniform(1.01, 3) * min_standoff(15, kLimits, felt);
    const OrbitResult r = plan_orbit(q);
    ASSERT_EQ(r.outcome, OrbitOutcome::kPlanned) << r.reason << " " << i;
    EXPECT_EQ(r.airspeed, 15);
    expect_flyable(r.plan, at_speed(r.airspeed), q.wind);
    EXPECT_EQ(r.plan.front().p_N, q.start.p_N);
    for (double t = 0; t <= q.duration; t += 0.37)
      ASSERT_NEAR(distance(q, r, r.entry_time + t), q.radius, 1.05 * q.tolerance) << i;
    EXPECT_NEAR(model::moment_at(r.plan, model::end_time_of(r.plan)).p_N.z(),
                -q.altitude_msl, 1e-6);
  }
}

TEST(Orbit, MinimumRadiusIsWhereTheTurnIsTightest) {
  // Turn rate of the heading along circles of 1 m, by differences.
  for (const double felt : {0.0, 3.0, 9.0, 14.0}) {
    double fastest = 0;
    const auto heading = [&](double chi) {
      return chi - std::asin(felt * std::sin(-chi) / 15);
    };
    for (double chi = 0; chi < 2 * geo::kPi; chi += 0.001) {
      const double q = std::sqrt(225 - std::pow(felt * std::sin(chi), 2));
      const double speed = felt * std::cos(chi) + q;
      const double turned = (heading(chi + 1e-5) - heading(chi - 1e-5)) / 2e-5;
      fastest = std::max(fastest, std::abs(turned) * speed);
    }
    EXPECT_NEAR(min_standoff(15, kLimits, felt), fastest * 40 / 15, 1e-3 * fastest);
  }
}

TEST(Orbit, FliesSlowerForATightCircleAndSaysWhatCanBeFlown) {
  OrbitQuery q = around_a_point();
  q.wind = {3, 0};
  q.radius = 50;  // 57.6 m at cruise, 34.8 m at 11 m/s
  OrbitResult r = plan_orbit(q);
  ASSERT_EQ(r.outcome, OrbitOutcome::kPlanned) << r.reason;
  EXPECT_LT(r.airspeed, 15);
  EXPECT_GE(r.airspeed, 11);
  expect_flyable(r.plan, at_speed(r.airspeed), q.wind);
  EXPECT_LE(r.largest_error, q.tolerance);
  q.radius = 20;
  r = plan_orbit(q);
  EXPECT_EQ(r.outcome, OrbitOutcome::kRadiusTooSmall);
  EXPECT_TRUE(r.plan.empty());
  q.radius = 1.0001 * r.min_radius;
  r = plan_orbit(q);
  EXPECT_EQ(r.outcome, OrbitOutcome::kPlanned) << r.reason;
}

TEST(Orbit, EntersAsEarlyAsAnyPlaceOfTheCircleAllows) {
  OrbitQuery q = around_a_point();
  q.target.velocity = {2, -3};
  q.wind = {-4, 1};
  const OrbitResult r = plan_orbit(q);
  ASSERT_EQ(r.outcome, OrbitOutcome::kPlanned);
  double earliest = 1e300;
  for (const int side : {1, -1})
    for (double b = 0; b < 2 * geo::kPi; b += 1e-3) {
      const Standoff s{q.target, q.radius, side, q.wind, {15, 40}};
      const model::Connection c = model::connect({{0, 0}, 1}, pose_on(s, b, 0),
                                                 {15, 40, q.wind - q.target.velocity});
      earliest = std::min(earliest, c.time);
    }
  EXPECT_LT(r.entry_time, earliest + 1e-3);
}

TEST(Orbit, FindsTheCircleAgainAfterCornersOfATrack) {
  OrbitQuery q = around_a_point();
  q.target.track = {{0, {300, 0}}, {120, {500, 0}}, {300, {500, 600}}, {500, {900, 600}}};
  q.wind = {2, 3};
  q.duration = 600;
  q.radius = 200;
  q.tolerance = 0.1;
  const OrbitResult r = plan_orbit(q);
  ASSERT_EQ(r.outcome, OrbitOutcome::kOutsideTolerance) << r.largest_error;
  expect_flyable(r.plan, kLimits, q.wind);
  // A change of the course by 0.3 rad at 0.3 rad/s: a second, in which 3 m/s lead astray.
  EXPECT_LT(r.largest_error, 3);
  EXPECT_NEAR(distance(q, r, r.entry_time + 590), 200, q.tolerance);
}

TEST(Weave, IsOverTheTargetAfterEachTurn) {
  RandomStream random(9, 0, Purpose::kTest);
  for (int i = 0; i < 40; ++i) {
    OrbitQuery q = around_a_point();
    q.kind = OrbitKind::kWeave;
    q.target.velocity = random.uniform(0, 8) * geo::unit(random.uniform(0, 6.3));
    q.wind = (i == 0 ? 0 : 1) * random.uniform(0, 6) * geo::unit(random.uniform(0, 6.3));
    if (i == 1) q.target.velocity = q.wind;
    const OrbitResult r = plan_orbit(q);
    ASSERT_EQ(r.outcome, OrbitOutcome::kPlanned) << r.reason;
    expect_flyable(r.plan, at_speed(r.airspeed), q.wind);
    int meetings = 0;
    for (const FlightElement& e : r.plan)
      if (e.start >= r.entry_time - 1e-9) {
        ++meetings;
        ASSERT_LT(distance(q, r, e.start), 1e-5) << i;
      }
    EXPECT_GT(meetings, 2);
    // A whole turn is 2 pi radii, so nobody is further than its diameter away.
    EXPECT_LE(r.farthest, 2 * turn_radius_at(r.airspeed, kLimits) + 1e-6);
  }
}

TEST(Weave, MeetsTheTargetAgainAfterCornersOfATrack) {
  OrbitQuery q = around_a_point();
  q.kind = OrbitKind::kWeave;
  q.target.track = {{0, {300, 0}}, {200, {900, 0}}, {400, {900, 700}}, {900, {900, 900}}};
  q.wind = {1, 3};
  q.duration = 700;
  const OrbitResult r = plan_orbit(q);
  ASSERT_EQ(r.outcome, OrbitOutcome::kPlanned) << r.reason;
  expect_flyable(r.plan, kLimits, q.wind);
  EXPECT_LT(distance(q, r, r.plan.back().start), 1e-5);
  EXPECT_GE(model::end_time_of(r.plan), r.entry_time + 700);
  EXPECT_LT(r.farthest, 500);
}

TEST(Weave, AngleAdvancesAsRequested) {
  for (const double ratio : {0.0, 0.1, 0.5, 0.9, 0.999, 1.0}) {
    const double a = weave_angle(ratio);
    EXPECT_NEAR(a < 1e-9 ? 1 : std::sin(a) / a, ratio, 1e-12) << ratio;
  }
}

TEST(Orbit, NamesWhatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto outcome = [](const auto& change) {
    OrbitQuery q = around_a_point();
    change(q);
    const OrbitResult r = plan_orbit(q);
    EXPECT_FALSE(r.reason.empty());
    return r.outcome;
  };
  using O = OrbitOutcome;
  EXPECT_EQ(outcome([](OrbitQuery& q) {
              q.target.velocity = {25, 0};
            }),
            O::kTargetTooFast);
  EXPECT_EQ(outcome([](OrbitQuery& q) {
              q.kind = OrbitKind::kWeave;
              q.target.velocity = {25, 0};
            }),
            O::kTargetTooFast);
  EXPECT_EQ(outcome([](OrbitQuery& q) { q.wind = {0, 20}; }), O::kWindTooStrong);
  EXPECT_EQ(outcome([](OrbitQuery& q) { q.radius = 5; }), O::kRadiusTooSmall);
  EXPECT_EQ(outcome([](OrbitQuery& q) { q.radius = 0; }), O::kBadOrbit);
  EXPECT_EQ(outcome([&](OrbitQuery& q) { q.duration = nan; }), O::kBadOrbit);
  EXPECT_EQ(outcome([&](OrbitQuery& q) { q.target.velocity.x() = nan; }), O::kBadTarget);
  EXPECT_EQ(outcome([](OrbitQuery& q) {
              q.target.track = {{0, {0, 0}}};
            }),
            O::kBadTarget);
  EXPECT_EQ(outcome([](OrbitQuery& q) {
              q.target.track = {{0, {0, 0}}, {0, {1, 0}}};
            }),
            O::kBadTarget);
  EXPECT_EQ(outcome([&](OrbitQuery& q) { q.start.heading = nan; }), O::kBadAircraft);
  EXPECT_EQ(outcome([](OrbitQuery& q) { q.limits.turn_radius = 0; }), O::kBadAircraft);
  EXPECT_EQ(outcome([](OrbitQuery& q) {
              q.altitude_msl = 200;
              q.limits.climb_rate = 0;
            }),
            O::kBadAircraft);
}

}  // namespace
}  // namespace skein::solve::orbit_test
