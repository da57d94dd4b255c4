// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/propagation/obstacle.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"
#include "skein/layer/communication/propagation/obstructed.h"
#include "skein/layer/communication/propagation/path_loss.h"

namespace skein::communication::obstacle_test {
namespace {

Obstacle block() {
  return {geo::Ring{{40, -10}, {60, -10}, {60, 10}, {40, 10}}, 0, 30, 12};
}

TEST(Obstacle, IsCrossedByLinesThroughItOnly) {
  const Obstacle wall = block();
  EXPECT_TRUE(is_crossed(wall, {0, 0, -10}, {100, 0, -10}));
  EXPECT_FALSE(is_crossed(wall, {0, 0, -31}, {100, 0, -31}));    // above it
  EXPECT_FALSE(is_crossed(wall, {0, 0, 1}, {100, 0, 1}));        // below it
  EXPECT_FALSE(is_crossed(wall, {0, 11, -10}, {100, 11, -10}));  // beside it
  EXPECT_FALSE(is_crossed(wall, {0, 0, -10}, {39, 0, -10}));     // before it
  EXPECT_TRUE(is_crossed(wall, {50, 0, -10}, {100, 0, -10}));    // from inside
  EXPECT_TRUE(is_crossed(wall, {45, 0, -10}, {55, 0, -10}));     // inside
  // It climbs over the near side, 30 m high at 40 m, or just not.
  EXPECT_FALSE(is_crossed(wall, {0, 0, -1}, {40, 0, -30.5}));
  EXPECT_TRUE(is_crossed(wall, {0, 0, -1}, {100, 0, -60}));
  EXPECT_FALSE(is_crossed(wall, {0, 0, -1}, {100, 0, -80}));
  // Straight up through it, and beside it.
  EXPECT_TRUE(is_crossed(wall, {50, 0, 5}, {50, 0, -50}));
  EXPECT_FALSE(is_crossed(wall, {50, 20, 5}, {50, 20, -50}));
}

TEST(Obstacle, MayBeACylinder) {
  const Obstacle tower{Disc{{50, 0}, 5}, 0, 30, 12};
  EXPECT_TRUE(is_crossed(tower, {0, 0, -10}, {100, 0, -10}));
  EXPECT_TRUE(is_crossed(tower, {0, 4.9, -10}, {100, 4.9, -10}));
  EXPECT_FALSE(is_crossed(tower, {0, 5.1, -10}, {100, 5.1, -10}));
  EXPECT_FALSE(is_crossed(tower, {0, 0, -31}, {100, 0, -31}));
  EXPECT_TRUE(is_crossed(tower, {50, 0, 5}, {50, 0, -50}));
}

TEST(Obstacle, IsTheSameInBothDirections) {
  const Obstacle wall = block(), tower{Disc{{20, 5}, 15}, 5, 25, 12};
  RandomStream random(1, 0, Purpose::kTest);
  const auto place = [&] {
    // Whole metres: many lines run along sides and through corners.
    return Vec3(std::floor(random.uniform(0, 100)), std::floor(random.uniform(-20, 20)),
                std::floor(random.uniform(-40, 5)));
  };
  int crossed = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 a = place(), b = place();
    const bool there = is_crossed(wall, a, b);
    crossed += there;
    ASSERT_EQ(there, is_crossed(wall, b, a)) << a.transpose() << " " << b.transpose();
    ASSERT_EQ(is_crossed(tower, a, b), is_crossed(tower, b, a));
  }
  EXPECT_GT(crossed, 2000);  // the test sees both cases
  EXPECT_LT(crossed, 18'000);
}

TEST(Obstructed, TakesTheDecibelsOfEachObstacle) {
  const Obstructed field(std::make_unique<FreeSpace>(2e9),
                         {block(), {Disc{{80, 0}, 5}, 0, 30, 3}});
  const FreeSpace open(2e9);
  const Vec3 a(0, 0, -10), b(70, 0, -10), c(100, 0, -10);
  EXPECT_EQ(field.received(1, a, {100, 50, -10}), open.received(1, a, {100, 50, -10}));
  // Tolerances: roundings of a power of ten.
  EXPECT_NEAR(field.received(1, a, b) / open.received(1, a, b), std::pow(10, -1.2),
              1e-12);
  EXPECT_NEAR(field.received(1, a, c) / open.received(1, a, c), std::pow(10, -1.5),
              1e-12);
}

TEST(Obstructed, AnOpaqueOneLetsNothingThrough) {
  Obstacle wall = block();
  wall.attenuation_db = math::kInfinity;
  const Obstructed field(std::make_unique<FixedPower>(-60), {wall});
  EXPECT_EQ(field.received(1, {0, 0, -10}, {100, 0, -10}), 0);
  EXPECT_GT(field.received(1, {0, 0, -40}, {100, 0, -40}), 0);
}

}  // namespace
}  // namespace skein::communication::obstacle_test
