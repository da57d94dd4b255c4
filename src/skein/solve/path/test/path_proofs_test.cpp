// SPDX-License-Identifier: Apache-2.0
// What planned paths claim, against computations that share no code with the planner.
// bench/path_proofs does the same with ten thousand problems.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "skein/solve/path/ground_speed.h"
#include "skein/solve/path/test/independent_flights.h"
#include "skein/solve/path/test/independent_paths.h"
#include "skein/solve/path/test/path_campaign.h"

namespace skein::solve::path_proofs_test {
namespace {

using independent::kPi;
using independent::Real;

TEST(PathProofs, BoundsAndShortestRoutesHoldAgainstAllTangents) {
  test::PathTally tally;
  for (std::uint32_t k = 0; k < 240; ++k) tally.add(test::check_path_claims(k));
  EXPECT_EQ(tally.problems, 240);
  EXPECT_GT(tally.paths, 150);
  EXPECT_GT(tally.shortest, 5);
  EXPECT_GT(tally.parted, 5);
  EXPECT_GT(tally.flights, 5);
  EXPECT_TRUE(tally.is_good()) << tally.first;
}

// The times of arcs, which every bound in wind is made of.
TEST(PathProofs, ArcsInWindTakeTheTimeOfTheirPieces) {
  for (const double ratio : {0.3, 0.9, 0.99}) {
    const GroundSpeed speed(20, 20 * ratio * geo::unit(0.7));
    for (double course = -3; course < 6; course += 1.3)
      for (const double turned : {0.003, -0.4, 2.9}) {
        constexpr int kPieces = 20'000;
        double time = 0;
        for (int i = 0; i < kPieces; ++i)
          time += 250 * std::abs(turned) / kPieces /
                  speed.along(geo::unit(course + (i + 0.5) * turned / kPieces));
        EXPECT_NEAR(speed.arc(250, course, turned), time,
                    250 * speed.arc_error() + 1e-7 * time);
      }
    EXPECT_LT(speed.arc_error(), ratio < 0.95 ? 1e-9 : 1e-5);
  }
}

// The checker itself: around one circle, whose length is known.
TEST(IndependentPaths, GoAroundACircle) {
  independent::Field field;
  field.circles.push_back({{0, 0}, 100});
  const independent::Air still{1, {}};
  const Real length = 2 * std::sqrt(Real(30000)) + 100 * kPi / 3;
  EXPECT_NEAR(static_cast<double>(
                  independent::point_time(field, still, {-200, 0}, {200, 0}) - length),
              0, 1e-12);
  // From the rim the other half is longer by nothing.
  EXPECT_NEAR(static_cast<double>(
                  independent::point_time(field, still, {-100, 0}, {100, 0}) - 100 * kPi),
              0, 1e-9);
  // An aircraft that begins and ends along the tangents flies just that.
  const independent::Pose from{{-200, 0}, kPi / 6}, to{{200, 0}, -kPi / 6};
  EXPECT_NEAR(
      static_cast<double>(independent::route_length(field, from, to, 60) - length), 0,
      1e-9);
  field.polygons.push_back({{-10, -1000}, {10, -1000}, {10, 1000}, {-10, 1000}});
  field.circles.push_back({{0, 1000}, 50});
  EXPECT_GT(independent::point_time(field, still, {-200, 0}, {200, 0}), 2000);
}

TEST(IndependentPaths, AreNearThoseOverManyPoints) {
  std::mt19937_64 engine(5);
  const auto draw = [&](Real low, Real high) {
    return low + (high - low) * static_cast<Real>(engine() >> 11) * 0x1p-53L;
  };
  for (int k = 0; k < 10; ++k) {
    independent::Field field;
    for (int i = 0; i < 4; ++i)
      field.circles.push_back({{draw(200, 800), draw(-150, 150)}, draw(20, 150)});
    field.polygons.push_back({{400, draw(-300, 0)}, {500, draw(0, 50)}, {400, 60}});
    const independent::Air air{20, {draw(-10, 10), draw(-10, 10)}};
    const Real exact = independent::point_time(field, air, {0, 0}, {1000, 0});
    const Real dense = independent::dense_point_time(field, air, {0, 0}, {1000, 0}, 24);
    EXPECT_GE(dense, exact * (1 - 1e-12L));
    EXPECT_LE(dense, exact * 1.005L);
  }
}

TEST(IndependentFlights, EndAtTheGoal) {
  std::mt19937_64 engine(6);
  const auto draw = [&](Real low, Real high) {
    return low + (high - low) * static_cast<Real>(engine() >> 11) * 0x1p-53L;
  };
  int regular = 0;
  for (int k = 0; k < 300; ++k) {
    const independent::Pose from{{0, 0}, draw(-4, 4)};
    const independent::Pose to{{draw(-500, 500), draw(-500, 500)}, draw(-4, 4)};
    const independent::Air air{20, {draw(-12, 12), draw(-12, 12)}};
    const auto meeting = independent::earliest_meeting(air, from, to, 60);
    if (!meeting) continue;
    regular += meeting->regular ? 1 : 0;
    independent::Point p = from.at;
    Real heading = from.heading;
    for (std::size_t i = 0; i < 3; ++i) {
      const int turn = meeting->word.turn[i];
      const Real part = meeting->word.part[i];
      if (turn == 0) {
        p = p + part * independent::unit(heading);
        continue;
      }
      const Real turned = turn * part / 60;
      const Real chord = 2 * 60 * std::sin(std::abs(turned) / 2);
      p = p + chord * independent::unit(heading + turned / 2);
      heading += turned;
    }
    p = p + meeting->time * air.wind;
    EXPECT_LT(independent::length(p - to.at), 1e-6L);
    EXPECT_LT(std::abs(std::remainder(heading - to.heading, 2 * kPi)), 1e-9L);
  }
  EXPECT_GT(regular, 20);
}

}  // namespace
}  // namespace skein::solve::path_proofs_test
