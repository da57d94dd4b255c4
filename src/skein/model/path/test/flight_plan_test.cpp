// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/flight_plan.h"

#include <gtest/gtest.h>

#include "skein/model/path/plan_curve.h"

namespace skein::model::flight_plan_test {
namespace {

FlightElement turn_in_wind(double rate) {
  FlightElement e;
  e.start = 5;
  e.duration = 12;
  e.p_N = {100, -40, -80};
  e.heading = 0.7;
  e.airspeed = 15;
  e.turn_rate = rate;
  e.climb_rate = 1.5;
  e.wind = {3, -4};
  return e;
}

// Runge and Kutta's fourth order at 1 ms is good to 1e-12 here.
Vec3 flown(const FlightElement& e, double t) {
  Vec3 p = e.p_N;
  const int steps = 2000;
  const double h = t / steps;
  const auto v = [&](double s) {
    const Vec2 g = e.airspeed * geo::unit(e.heading + e.turn_rate * s) + e.wind;
    return Vec3(g.x(), g.y(), -e.climb_rate);
  };
  for (int i = 0; i < steps; ++i)
    p += h / 6 * (v(i * h) + 4 * v((i + 0.5) * h) + v((i + 1) * h));
  return p;
}

TEST(FlightElement, MovesAsItsVelocityIntegrated) {
  for (const double rate : {0.0, 1e-9, -1e-6, 1e-4, 0.3, -0.5})
    for (const double t : {0.0, 0.1, 4.0, 12.0}) {
      const FlightElement e = turn_in_wind(rate);
      EXPECT_LT((position(e, t) - flown(e, t)).norm(), 1e-9) << rate << " " << t;
      const FlightMoment m = moment(e, t);
      EXPECT_NEAR(m.heading, e.heading + rate * t, 1e-12);
      const double h = 1e-4;  // central difference: V r^2 h^2 / 6 is 1e-8
      EXPECT_LT((m.v_N - (position(e, t + h) - position(e, t - h)) / (2 * h)).norm(),
                1e-7);
    }
}

TEST(FlightElement, LengthOverGroundIsTheSumOfItsChords) {
  for (const Vec2& wind : {Vec2(0, 0), Vec2(5, 0), Vec2(0, -14.5)}) {
    FlightElement e = turn_in_wind(0.4);
    e.wind = wind;
    double chords = 0;
    const int n = 200'000;
    for (int i = 0; i < n; ++i)
      chords += geo::horizontal(position(e, e.duration * (i + 1) / n) -
                                position(e, e.duration * i / n))
                    .norm();
    // Chords are short by (turn of the track)^2 / 24 each, worst near the standstill.
    EXPECT_NEAR(ground_length(e) / chords, 1, 1e-7) << wind.transpose();
  }
}

FlightPlan turn_and_straight() {
  FlightElement turn = turn_in_wind(0.2);
  FlightElement straight = turn;
  const FlightMoment end = end_of(turn);
  straight.turn_rate = 0;
  straight.p_N = end.p_N;
  straight.heading = end.heading;
  FlightPlan plan{turn};
  append(plan, {straight});
  return plan;
}

TEST(FlightPlan, KnowsItsTimesAndMoments) {
  const FlightPlan plan = turn_and_straight();
  EXPECT_EQ(start_of(plan), 5);
  EXPECT_EQ(end_time_of(plan), 29);
  EXPECT_EQ(duration(plan), 24);
  EXPECT_EQ(duration(FlightPlan{}), 0);
  EXPECT_LT((moment_at(plan, 17 - 1e-9).p_N - moment_at(plan, 17 + 1e-9).p_N).norm(),
            1e-7);
  EXPECT_LT((moment_at(plan, 20).p_N - position(plan[1], 3)).norm(), 1e-12);
  // Before its start the first element goes on.
  EXPECT_LT((moment_at(plan, 4).p_N - position(plan[0], -1)).norm(), 1e-12);
  EXPECT_NEAR(ground_length(plan), ground_length(plan[0]) + ground_length(plan[1]), 1e-9);
}

TEST(FlightPlan, SamplesLieWithinTheBoundOfTheCubicCurve) {
  const FlightPlan plan = turn_and_straight();
  PlanCurve curve;
  curve.assign(sample(plan, {0.2}));
  // V/r (0.2)^4 / 384 with V/r = 75 m is 0.31 mm.
  double worst = 0;
  for (double t = 5; t <= 29; t += 0.01)
    worst = std::max(worst, (curve.at(t).p_N - moment_at(plan, t).p_N).norm());
  EXPECT_LT(worst, 3.2e-4);
  EXPECT_GT(worst, 1e-5);  // and is not there by chance
  // 2.4 rad by at most 0.2, the straight in one.
  EXPECT_EQ(sample(plan, {0.2}).size(), 12u + 1u + 1u);
  EXPECT_EQ(sample(plan, {0.2, 5}).size(), 12u + 3u + 1u);
}

TEST(FlightPlan, CornersAreSampledWhereTheyAre) {
  // Climbs for ten seconds and is level at once: the cubic curve through the ends alone
  // would climb by a half more than the plan does, all along.
  FlightElement climb;
  climb.airspeed = 20;
  climb.duration = 10;
  climb.climb_rate = 3;
  FlightElement level = climb;
  level.start = 10;
  level.p_N = end_of(climb).p_N;
  level.climb_rate = 0;
  PlanCurve curve;
  curve.assign(sample({climb, level}));
  for (double t = 0.5; t < 9.9; t += 0.1) EXPECT_NEAR(-curve.at(t).v_N.z(), 3, 1e-6) << t;
}

// Of elements that last milliseconds, what is rounded to be sent would be another speed.
TEST(FlightPlan, PointsAreNotMillisecondsApart) {
  FlightElement climb;
  climb.airspeed = 20;
  climb.climb_rate = 3;
  climb.duration = 0.02;
  FlightElement turn = climb;
  turn.start = 0.02;
  turn.climb_rate = 0;
  turn.turn_rate = 0.2;
  turn.duration = 0.01;
  turn.p_N = end_of(climb).p_N;
  FlightElement on = turn;
  on.start = 0.03;
  on.turn_rate = 0;
  on.duration = 100;
  on.p_N = end_of(turn).p_N;
  on.heading = end_of(turn).heading;
  FlightElement last = on;
  last.start = 100.03;
  last.duration = 0.004;
  last.p_N = end_of(on).p_N;
  const Plan points = sample({climb, turn, on, last});
  for (std::size_t k = 1; k < points.size(); ++k)
    EXPECT_GE((points[k].time - points[k - 1].time).seconds(), 0.05) << k;
  EXPECT_EQ(points.front().time, Time());
  EXPECT_NEAR(points.front().v_N.z(), 0, 1e-12) << "of what is flown from there";
  EXPECT_NEAR(points.back().time.seconds(), 100.034, 1e-9);
}

TEST(FlightPlan, MovesInTime) {
  const FlightPlan moved = starting_at(turn_and_straight(), 100);
  EXPECT_EQ(start_of(moved), 100);
  EXPECT_EQ(moved[1].start, 112);
}

}  // namespace
}  // namespace skein::model::flight_plan_test
