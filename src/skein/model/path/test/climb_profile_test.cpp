// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/climb_profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/random.h"
#include "skein/model/path/flight_plan.h"

namespace skein::model::climb_profile_test {
namespace {

double duration_of(const ClimbProfile& profile) {
  double time = 0;
  for (const ClimbPiece& p : profile) time += p.duration;
  return time;
}

double height_of(const ClimbProfile& profile) {
  double height = 0;
  for (const ClimbPiece& p : profile)
    height += (p.rate + p.acceleration * p.duration / 2) * p.duration;
  return height;
}

// Largest rate; every piece must begin with the rate that the one before it ends with.
double rate_of(const ClimbProfile& profile) {
  double rate = 0, largest = 0;
  for (const ClimbPiece& p : profile) {
    EXPECT_NEAR(p.rate, rate, 1e-9);
    rate = p.rate + p.acceleration * p.duration;
    largest = std::max({largest, std::abs(p.rate), std::abs(rate)});
  }
  EXPECT_NEAR(rate, 0, 1e-9) << "it does not end level";
  return largest;
}

RandomStream draws() {
  return RandomStream(5, 0, Purpose::kTest);
}

TEST(ClimbProfile, LeastTimeByHand) {
  EXPECT_EQ(climb_time(0, 0, 1), 0);
  EXPECT_EQ(climb_time(30, 3, 0), 10);
  // 2 s up to 2 m/s and 2 s back take 4 m; the other 26 m take 13 s.
  EXPECT_DOUBLE_EQ(climb_time(30, 2, 1), 17);
  EXPECT_DOUBLE_EQ(climb_time(1, 2, 1), 2) << "the rate is never reached";
  EXPECT_TRUE(std::isinf(climb_time(5, 0, 1)));
}

TEST(ClimbProfile, QuickestClimbKeepsWithinRateAndAcceleration) {
  RandomStream random = draws();
  for (int i = 0; i < 500; ++i) {
    const double climb = random.uniform(-200, 200);
    const double rate = random.uniform(0.3, 8), a = random.uniform(0.1, 5);
    const ClimbProfile profile = quickest_climb(climb, rate, a);
    EXPECT_NEAR(height_of(profile), climb, 1e-9 * std::abs(climb));
    EXPECT_LE(rate_of(profile), rate * (1 + 1e-6));
    for (const ClimbPiece& p : profile) EXPECT_LE(std::abs(p.acceleration), a + 1e-9);
    EXPECT_NEAR(duration_of(profile), climb_time(std::abs(climb), rate, a), 1e-9);
  }
}

TEST(ClimbProfile, EvenClimbTakesItsTimeWithTheSmallestRate) {
  RandomStream random = draws();
  for (int i = 0; i < 500; ++i) {
    const double climb = random.uniform(-200, 200), a = random.uniform(0.1, 5);
    const double least = climb_time(std::abs(climb), 4, a);
    const double time = least * random.uniform(1, 5);
    const ClimbProfile profile = even_climb(climb, time, a);
    EXPECT_NEAR(duration_of(profile), time, 1e-9 * time);
    EXPECT_NEAR(height_of(profile), climb, 1e-9 * std::abs(climb));
    const double rate = rate_of(profile);
    EXPECT_LE(rate, 4 * (1 + 1e-6));
    EXPECT_GE(climb_time(std::abs(climb), rate * 0.999, a), time * (1 - 1e-9))
        << "a smaller rate would do";
  }
  EXPECT_TRUE(even_climb(0, 10, 1).empty());
  const ClimbProfile at_once = even_climb(20, 10, 0);
  ASSERT_EQ(at_once.size(), 1U);
  EXPECT_EQ(at_once.front().rate, 2);
  // Too little time: up and down again as hard as it takes.
  EXPECT_NEAR(height_of(even_climb(50, 10, 1)), 50, 1e-9);
}

// The horizontal motion of a plan is not touched, its altitude is the profile's.
TEST(ClimbProfile, PlansClimbAlongTheirPath) {
  RandomStream random = draws();
  for (int i = 0; i < 200; ++i) {
    FlightPlan level;
    FlightElement e;
    e.start = 50;
    e.airspeed = 20;
    e.wind = {random.uniform(-9, 9), random.uniform(-9, 9)};
    for (int k = 0; k < 5; ++k) {
      e.duration = random.uniform(0.5, 12);
      e.turn_rate = random.uniform(-0.3, 0.3);
      level.push_back(e);
      const FlightMoment end = end_of(e);
      e.start += e.duration;
      e.p_N = end.p_N;
      e.heading = end.heading;
    }
    const double climb = random.uniform(-20, 20), a = random.uniform(0.5, 3);
    const ClimbProfile profile = quickest_climb(climb, 5, a);
    const FlightPlan plan = climbing(level, -100, profile);
    EXPECT_NEAR(end_time_of(plan), end_time_of(level), 1e-9);
    const bool whole = duration_of(profile) <= duration(level);
    if (whole) {
      EXPECT_NEAR(-end_of(plan.back()).p_N.z(), 100 + climb, 1e-9);
    }
    double height = 100, rate = 0, time = 50;
    for (const FlightElement& piece : plan) {
      EXPECT_NEAR(piece.start, time, 1e-9);
      EXPECT_NEAR(-piece.p_N.z(), height, 1e-9);
      EXPECT_NEAR(piece.climb_rate, rate, 1e-6);
      const FlightMoment end = end_of(piece);
      time = piece.start + piece.duration;
      height = -end.p_N.z();
      rate = -end.v_N.z();
      const FlightMoment there = moment_at(level, piece.start + piece.duration / 2);
      const FlightMoment here = moment(piece, piece.duration / 2);
      EXPECT_LT((there.p_N - here.p_N).head<2>().norm(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace skein::model::climb_profile_test
