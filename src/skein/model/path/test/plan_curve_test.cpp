// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/plan_curve.h"

#include <gtest/gtest.h>

#include "skein/base/check.h"

namespace skein::model::plan_curve_test {
namespace {

Plan sample() {
  return {{Time::from_seconds(10), {0, 0, -100}, {15, 0, 0}},
          {Time::from_seconds(14), {55, 20, -103}, {8, 12, -1}},
          {Time::from_seconds(20), {60, 110, -110}, {-5, 14, 0}}};
}

PlanCurve curve_of(const Plan& plan) {
  PlanCurve curve;
  curve.assign(plan);
  return curve;
}

TEST(PlanCurve, PassesItsPointsWithTheirVelocities) {
  const Plan plan = sample();
  const PlanCurve curve = curve_of(plan);
  for (const PlanPoint& point : plan)
    for (const double side : {-1e-9, 0.0, 1e-9}) {
      const PlanCurve::State at = curve.at(point.time.seconds() + side);
      // A nanosecond at 15 m/s, and rounding.
      EXPECT_LT((at.p_N - point.p_N).norm(), 1e-7);
      EXPECT_LT((at.v_N - point.v_N).norm(), 1e-6);
    }
}

TEST(PlanCurve, ItsRatesAreThoseOfItsPositions) {
  const PlanCurve curve = curve_of(sample());
  const double h = 1e-4;
  for (const double t : {10.5, 12.0, 13.9, 14.2, 17.0, 19.5}) {
    const auto before = curve.at(t - h), at = curve.at(t), after = curve.at(t + h);
    // Central differences: h^2 times the third derivative, below 1e-6.
    EXPECT_LT(((after.p_N - before.p_N) / (2 * h) - at.v_N).norm(), 1e-6);
    EXPECT_LT(((after.v_N - before.v_N) / (2 * h) - at.a_N).norm(), 1e-6);
    const TrackPoint track = PlanCurve::track(at);
    const double turned = geo::bearing(PlanCurve::track(after).tangent) -
                          geo::bearing(PlanCurve::track(before).tangent);
    const double flown = 2 * h * at.v_N.head<2>().norm();
    EXPECT_NEAR(track.curvature, turned / flown, 1e-6);
  }
}

TEST(PlanCurve, GoesStraightOnBeyondItsEnds) {
  const PlanCurve curve = curve_of(sample());
  EXPECT_LT((curve.at(8).p_N - Vec3(-30, 0, -100)).norm(), 1e-12);
  EXPECT_LT((curve.at(22).p_N - Vec3(50, 138, -110)).norm(), 1e-12);
  EXPECT_EQ(curve.at(22).a_N, Vec3::Zero());
  const PlanCurve single = curve_of({sample()[0]});
  EXPECT_LT((single.at(12).p_N - Vec3(30, 0, -100)).norm(), 1e-12);
  EXPECT_EQ(single.remaining(10), 0);
}

TEST(PlanCurve, FollowsThePointNearestToAMovingOne) {
  const PlanCurve curve = curve_of(sample());
  // Beside the curve, 8 m off, at 100 Hz with its own speed.
  double time = 10;
  for (double t = 10; t < 20; t += 0.01) {
    const PlanCurve::State at = curve.at(t);
    const TrackPoint track = PlanCurve::track(at);
    for (const double off : {8.0}) {
      const Vec2 p = at.p_N.head<2>() + off * geo::turned_right(track.tangent);
      time = curve.follow(p, time);
      EXPECT_NEAR(time, t, 1e-3);
    }
  }
}

TEST(PlanCurve, FindsTheNearestPointFromAfar) {
  const PlanCurve curve = curve_of(sample());
  const PlanCurve::State at = curve.at(16.3);
  const TrackPoint track = PlanCurve::track(at);
  const Vec2 p = at.p_N.head<2>() + 10 * geo::turned_right(track.tangent);
  EXPECT_NEAR(curve.nearest(p, 10, 20, 1), 16.3, 1e-6);
}

TEST(PlanCurve, WhereItStandsStillTimeIsKept) {
  const PlanCurve curve = curve_of({{Time::from_seconds(0), {0, 0, 0}, {0, 0, 0}},
                                    {Time::from_seconds(5), {0, 0, -10}, {0, 0, 0}}});
  EXPECT_EQ(curve.follow({3, 4}, 2), 2);
  EXPECT_EQ(PlanCurve::track(curve.at(2)).tangent, Vec2(1, 0));
}

TEST(PlanCurve, KnowsItsLength) {
  // A quarter circle of 100 m in ten parts: Hermite and chords are within 0.1 %.
  Plan plan;
  for (int i = 0; i <= 10; ++i) {
    const double angle = i * geo::kPi / 20;
    const Vec2 v = 10 * geo::unit(angle);
    plan.push_back({Time::from_seconds(10 * angle),
                    {100 * std::sin(angle), 100 - 100 * std::cos(angle), 0},
                    {v.x(), v.y(), 0}});
  }
  const PlanCurve curve = curve_of(plan);
  EXPECT_NEAR(curve.remaining(0), 50 * geo::kPi, 0.2);
  EXPECT_NEAR(curve.remaining(curve.end() / 2), 25 * geo::kPi, 0.2);
  EXPECT_EQ(curve.remaining(curve.end() + 1), 0);
}

TEST(PlanCurve, TimesMustGrow) {
  PlanCurve curve;
  EXPECT_THROW(curve.assign({sample()[1], sample()[0]}), Bug);
}

}  // namespace
}  // namespace skein::model::plan_curve_test
