// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/propagation/path_loss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::communication::path_loss_test {
namespace {

double dbm(double watts) {
  return 10 * std::log10(watts * 1e3);
}

TEST(FreeSpace, LosesTwentyDecibelsEachDecade) {
  const FreeSpace field(2e9);
  // 1 dBm and 1 dB of gain at both ends: -75.5 dBm at 100 m, -81.5 at 200 m.
  const double radiated = 1e-3 * std::pow(10, 0.3);
  EXPECT_NEAR(dbm(field.received(radiated, {0, 0, 0}, {100, 0, 0})), -75.46, 0.01);
  EXPECT_NEAR(dbm(field.received(radiated, {0, 0, 0}, {0, 120, -160})), -81.48, 0.01);
  EXPECT_EQ(field.received(radiated, {5, 5, 5}, {5, 5, 5}), radiated);
}

TEST(TwoRay, IsFreeSpaceNearbyAndFallsWithTheFourthPowerBeyond) {
  const TwoRay field(2.4e9, 2);
  const FreeSpace open(2.4e9);
  EXPECT_EQ(field.received(1, {0, 0, 0}, {100, 0, 0}),
            open.received(1, {0, 0, 0}, {100, 0, 0}));
  const double near = field.received(1, {0, 0, 0}, {2000, 0, 0});
  EXPECT_NEAR(near / field.received(1, {0, 0, 0}, {4000, 0, 0}), 16, 1e-9);
  EXPECT_LT(near, open.received(1, {0, 0, 0}, {2000, 0, 0}));
  // No step where the one follows the other.
  const double change = 4 * geo::kPi * 4 * 2.4e9 / 299'792'458;
  EXPECT_NEAR(field.received(1, {0, 0, 0}, {change * 1.0001, 0, 0}) /
                  field.received(1, {0, 0, 0}, {change * 0.9999, 0, 0}),
              1, 1e-3);
}

// Two antennas over the plain of a highland are not 500 m above the ground.
TEST(TwoRay, CountsHeightsFromTheGroundBelow) {
  struct Plain final : Terrain {
    explicit Plain(double height) : elevation(height) {}
    double elevation_msl(const Vec2&) const override { return elevation; }
    Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
    double elevation;
  };
  const Plain sea(0), highland(500);
  const TwoRay low(2.4e9, 1, &sea), high(2.4e9, 1, &highland);
  const Vec3 from(0, 0, -2), to(4000, 0, -10), up(0, 0, -500);
  EXPECT_EQ(high.received(1, from + up, to + up), low.received(1, from, to));
  EXPECT_EQ(TwoRay(2.4e9, 1).received(1, from, to), low.received(1, from, to));
  EXPECT_LT(low.received(1, from, to), FreeSpace(2.4e9).received(1, from, to));
}

TEST(LogDistance, FallsWithItsExponent) {
  PropagationProfile profile;
  profile.exponent = 3.5;
  const LogDistance field(2.4e9, profile, 1);
  const double decade = field.received(1, {0, 0, 0}, {10, 0, 0}) /
                        field.received(1, {0, 0, 0}, {100, 0, 0});
  EXPECT_NEAR(10 * std::log10(decade), 35, 1e-9);
  // At the reference distance of 1 m it is free space.
  EXPECT_NEAR(field.received(1, {0, 0, 0}, {1, 0, 0}),
              FreeSpace(2.4e9).received(1, {0, 0, 0}, {1, 0, 0}), 1e-15);
}

TEST(LogDistance, ShadowingHasItsSpreadAndIsAlikeNearby) {
  PropagationProfile profile;
  profile.shadowing_db = 8;
  profile.shadowing_distance = 50;
  double squares = 0, near = 0, far = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const LogDistance field(2.4e9, profile, seed);
    for (int k = 0; k < 5; ++k) {
      const Vec3 place(1000.0 * k, 700, 0);
      const double here = field.shadowing_db(place);
      squares += here * here;
      near += here * field.shadowing_db(place + Vec3(50, 0, 0));
      far += here * field.shadowing_db(place + Vec3(0, 400, 0));
      ++count;
    }
  }
  // 2,000 places: the spread of a variance is 3 %, of a correlation 2 to 3 points.
  EXPECT_NEAR(std::sqrt(squares / count), 8, 0.4);
  EXPECT_NEAR(near / squares, std::exp(-1), 0.08);
  EXPECT_NEAR(far / squares, 0, 0.08);
  // A link is the same in both directions.
  const LogDistance field(2.4e9, profile, 7);
  EXPECT_EQ(field.received(1, {0, 0, 0}, {300, 40, 0}),
            field.received(1, {300, 40, 0}, {0, 0, 0}));
}

TEST(FixedPower, IsTheSameEverywhere) {
  EXPECT_NEAR(FixedPower(-60).received(1, {0, 0, 0}, {9e5, 0, 0}), 1e-9, 1e-15);
}

}  // namespace
}  // namespace skein::communication::path_loss_test
