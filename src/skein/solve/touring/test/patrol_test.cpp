// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/touring/patrol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "skein/base/random.h"
#include "skein/solve/path/test/plan_checks.h"

namespace skein::solve::patrol_test {
namespace {

const FlightLimits kLimits{15, 40, 3, 11, 20, 3};

PatrolQuery along_a_bend() {
  PatrolQuery q;
  q.line = {{0, 0}, {1000, 0}, {1500, 600}, {1400, 1400}};
  q.limits = kLimits;
  q.starts = {{{-100, 50, -90}, 2}};
  return q;
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 leg = b - a;
  const double s = std::clamp(leg.dot(p - a) / leg.squaredNorm(), 0.0, 1.0);
  return (p - a - s * leg).norm();
}

std::vector<Vec2> track(const FlightPlan& plan, double from) {
  std::vector<Vec2> points;
  for (double t = from; t <= model::end_time_of(plan); t += 0.25)
    points.push_back(geo::horizontal(model::moment_at(plan, t).p_N));
  return points;
}

// How far points of the line are from the flight, at most.
double unseen(const PatrolQuery& q, const std::vector<Vec2>& flown) {
  double far = 0;
  for (std::size_t k = 0; k + (q.closed ? 0 : 1) < q.line.size(); ++k)
    for (double s = 0; s <= 1; s += 0.02) {
      const Vec2 p = q.line[k] + s * (q.line[(k + 1) % q.line.size()] - q.line[k]);
      double near = 1e300;
      for (std::size_t i = 0; i + 1 < flown.size(); ++i)
        if ((flown[i] - p).norm() < near + 10)
          near = std::min(near, distance(p, flown[i], flown[i + 1]));
      far = std::max(far, near);
    }
  return far;
}

TEST(Patrol, KeepsWithinTheToleranceOfTheLine) {
  RandomStream random(31, 0, Purpose::kTest);
  for (int i = 0; i < 30; ++i) {
    PatrolQuery q = along_a_bend();
    q.wind = random.uniform(0, 9) * geo::unit(random.uniform(0, 6.3));
    q.tolerance = random.uniform(5, 60);
    q.closed = i % 3 == 0;
    q.rounds = 1 + i % 2;
    const PatrolResult r = plan_patrol(q);
    ASSERT_EQ(r.outcome, PatrolOutcome::kPlanned) << r.reason;
    expect_flyable(r.plans[0], kLimits, q.wind);
    EXPECT_EQ(r.plans[0].front().p_N, q.starts[0].p_N);
    EXPECT_EQ(r.passes[0], q.closed ? q.rounds : 2 * q.rounds);
    EXPECT_LE(r.largest_deviation, q.tolerance);
    const std::vector<Vec2> flown = track(r.plans[0], r.begins[0]);
    EXPECT_LE(unseen(q, flown), q.tolerance + 0.5) << i;
    if (r.flown_over > 0 || !q.closed) continue;
    for (const Vec2& p : flown) {
      double near = 1e300;
      for (std::size_t k = 0; k < q.line.size(); ++k)
        near = std::min(near, distance(p, q.line[k], q.line[(k + 1) % q.line.size()]));
      ASSERT_LE(near, q.tolerance + 0.5) << i;
    }
  }
}

TEST(Patrol, FliesOverTheWholeLineWhenAsked) {
  PatrolQuery q = along_a_bend();
  q.line[2] = {300, 300};  // a sharp corner
  q.corners = PatrolCorners::kFlownOver;
  q.wind = {4, -5};
  const PatrolResult r = plan_patrol(q);
  ASSERT_EQ(r.outcome, PatrolOutcome::kPlanned) << r.reason;
  expect_flyable(r.plans[0], kLimits, q.wind);
  EXPECT_LT(unseen(q, track(r.plans[0], r.begins[0])), 0.1);  // chords of quarter seconds
  q.corners = PatrolCorners::kRounded;
  q.tolerance = 40;
  const PatrolResult round = plan_patrol(q);
  EXPECT_LT(round.round_time, r.round_time);
}

TEST(Patrol, FliesBesideTheLine) {
  PatrolQuery q = along_a_bend();
  q.offset = -50;
  q.tolerance = 5;
  q.wind = {0, 6};
  const PatrolResult r = plan_patrol(q);
  ASSERT_EQ(r.outcome, PatrolOutcome::kPlanned) << r.reason;
  // In the middle of the first leg, in both directions, 50 m to the west.
  int seen = 0;
  for (const FlightElement& e : r.plans[0])
    if (e.turn_rate == 0 && e.start > r.begins[0] - 1e-9) {
      const Vec2 a = geo::horizontal(e.p_N), b = geo::horizontal(model::end_of(e).p_N);
      if (distance({500, -50}, a, b) < 1e-6) ++seen;
    }
  EXPECT_EQ(seen, 2);
}

TEST(Patrol, SpreadsAircraftEvenlyInTime) {
  PatrolQuery q = along_a_bend();
  q.wind = {5, 2};
  q.rounds = 3;
  q.starts = {{{-300, 0, -100}, 0}, {{2000, 900, -110}, 1}, {{-200, -200, -60}, 3}};
  const PatrolResult r = plan_patrol(q);
  ASSERT_EQ(r.outcome, PatrolOutcome::kPlanned) << r.reason;
  EXPECT_NEAR(r.interval, r.round_time / 3, 1e-9);
  std::vector<double> begins = r.begins;
  std::sort(begins.begin(), begins.end());
  EXPECT_NEAR(begins[1] - begins[0], r.interval, 1e-9);
  EXPECT_NEAR(begins[2] - begins[1], r.interval, 1e-9);
  for (std::size_t k = 0; k < 3; ++k) {
    expect_flyable(r.plans[k], kLimits, q.wind);
    // One round later it is at the same place.
    const double t = r.begins[k] + 40;
    EXPECT_LT((model::moment_at(r.plans[k], t).p_N -
               model::moment_at(r.plans[k], t + r.round_time).p_N)
                  .norm(),
              1e-4);
  }
}

TEST(Patrol, EndsByATime) {
  PatrolQuery q = along_a_bend();
  const PatrolResult one = plan_patrol(q);
  for (const double more : {0.0, 1.0, 2.4, 5.6}) {
    q.until = one.first_end + more * one.round_time;
    const PatrolResult r = plan_patrol(q);
    ASSERT_EQ(r.outcome, PatrolOutcome::kPlanned) << r.reason;
    EXPECT_LE(model::end_time_of(r.plans[0]), *q.until + 1e-6);
    EXPECT_EQ(r.passes[0], 1 + static_cast<int>(2 * more + 0.05)) << more;
  }
  q.until = one.first_end - 1;
  const PatrolResult none = plan_patrol(q);
  EXPECT_EQ(none.outcome, PatrolOutcome::kNoTime);
  EXPECT_NEAR(none.first_end, one.first_end, 1e-9);
}

TEST(Patrol, NamesWhatCannotBe) {
  const auto outcome = [](const auto& change) {
    PatrolQuery q = along_a_bend();
    change(q);
    const PatrolResult r = plan_patrol(q);
    EXPECT_FALSE(r.reason.empty());
    return r.outcome;
  };
  using O = PatrolOutcome;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outcome([](PatrolQuery& q) { q.line.resize(1); }), O::kBadLine);
  EXPECT_EQ(outcome([](PatrolQuery& q) { q.line[1] = q.line[0]; }), O::kBadLine);
  EXPECT_EQ(outcome([&](PatrolQuery& q) { q.line[1].x() = nan; }), O::kBadLine);
  EXPECT_EQ(outcome([&](PatrolQuery& q) { q.offset = nan; }), O::kBadPatrol);
  EXPECT_EQ(outcome([](PatrolQuery& q) { q.tolerance = 0; }), O::kBadPatrol);
  EXPECT_EQ(outcome([](PatrolQuery& q) { q.rounds = 0; }), O::kBadPatrol);
  EXPECT_EQ(outcome([](PatrolQuery& q) { q.starts.clear(); }), O::kBadAircraft);
  EXPECT_EQ(outcome([](PatrolQuery& q) { q.wind = {0, -16}; }), O::kWindTooStrong);
}

}  // namespace
}  // namespace skein::solve::patrol_test
