// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/geofence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "skein/base/random.h"

namespace skein::autopilot::geofence_test {
namespace {

// A square of 1 km, positive (clockwise on the map), with a hole of 200 m in its middle.
GeofenceOptions square_with_hole() {
  GeofenceOptions options;
  options.area = {{{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}},
                  {{400, 400}, {400, 600}, {600, 600}, {600, 400}}};
  options.ceiling_msl = 300;
  options.floor_msl = 50;
  return options;
}

Vec3 at(double north, double east, double altitude) {
  return {north, east, -altitude};
}

TEST(Geofence, ClearanceIsTheDistanceToTheNearestLimit) {
  const Geofence fence(square_with_hole());
  EXPECT_DOUBLE_EQ(fence.clearance(at(100, 500, 200), true), 100);  // the ceiling too
  EXPECT_DOUBLE_EQ(fence.clearance(at(30, 500, 200), true), 30);
  EXPECT_DOUBLE_EQ(fence.clearance(at(-30, 500, 200), true), -30);
  EXPECT_DOUBLE_EQ(fence.clearance(at(390, 500, 200), true), 10);
  EXPECT_DOUBLE_EQ(fence.clearance(at(450, 500, 200), true), -50);  // in the hole
  EXPECT_DOUBLE_EQ(fence.clearance(at(200, 200, 320), true), -20);
  EXPECT_DOUBLE_EQ(fence.clearance(at(200, 200, 45), true), -5);
  EXPECT_DOUBLE_EQ(fence.clearance(at(150, 200, 45), false), 150);
  EXPECT_DOUBLE_EQ(fence.clearance(at(-3, -4, 200), true), -5);  // off a corner
}

TEST(Geofence, WithoutLimitsNothingIsOutside) {
  const Geofence fence{GeofenceOptions{}};
  EXPECT_TRUE(std::isinf(fence.clearance(at(1e6, -1e6, 1e5), true)));
  FenceWatch watch(fence);
  EXPECT_FALSE(watch.step(at(0, 0, 0), Vec3::Zero(), true));
  EXPECT_FALSE(watch.step(at(1e6, 0, -1e4), Vec3(100, 0, 0), true));
}

TEST(Geofence, MarginMovesTheFenceInwards) {
  GeofenceOptions options = square_with_hole();
  options.margin = 20;
  EXPECT_DOUBLE_EQ(Geofence(options).clearance(at(30, 500, 200), true), 10);
}

TEST(Geofence, OptionsSayWhatIsWrongWithThem) {
  EXPECT_FALSE(error_in(square_with_hole()));
  GeofenceOptions options = square_with_hole();
  options.ceiling_msl = 50;
  EXPECT_EQ(error_in(options).value_or("").find("ceiling_msl"), 0u);
  options = square_with_hole();
  options.area.push_back({{0, 0}, {1, 1}});
  EXPECT_EQ(error_in(options).value_or("").find("area"), 0u);
  options = square_with_hole();
  options.hysteresis = -1;
  EXPECT_EQ(error_in(options).value_or("").find("hysteresis"), 0u);
}

TEST(FenceWatch, ComesBackOnlyByTheHysteresis) {
  const Geofence fence(square_with_hole());
  FenceWatch watch(fence);
  const auto outside = [&](double north) {
    return watch.step(at(north, 500, 200), Vec3::Zero(), true);
  };
  EXPECT_FALSE(outside(1));
  EXPECT_TRUE(outside(-1));
  EXPECT_TRUE(outside(1));
  EXPECT_TRUE(outside(5));
  EXPECT_FALSE(outside(5.1));
  EXPECT_FALSE(outside(1));
}

TEST(FenceWatch, LooksAhead) {
  GeofenceOptions options = square_with_hole();
  options.look_ahead = 4;
  const Geofence fence(options);
  FenceWatch watch(fence);
  EXPECT_FALSE(watch.step(at(100, 500, 200), Vec3(-20, 0, 0), true));
  EXPECT_TRUE(watch.step(at(79, 500, 200), Vec3(-20, 0, 0), true));
}

TEST(FenceWatch, TakeOffAndLandingCrossTheFloor) {
  const Geofence fence(square_with_hole());
  FenceWatch watch(fence);
  EXPECT_FALSE(watch.step(at(200, 200, 0), Vec3::Zero(), false));
  EXPECT_TRUE(watch.step(at(200, 200, 0), Vec3::Zero(), true));
}

// The short cut of FenceWatch against the plain rule, on a walk in and out.
TEST(FenceWatch, AgreesWithMeasuringAtEveryStep) {
  for (const double look_ahead : {0.0, 3.0}) {
    GeofenceOptions options = square_with_hole();
    options.look_ahead = look_ahead;
    options.margin = 10;
    const Geofence fence(options);
    FenceWatch watch(fence);
    RandomStream random(11, 0, Purpose::kTest);
    Vec3 p = at(200, 200, 200), v = Vec3::Zero();
    bool outside = false;
    int crossings = 0;
    for (int k = 0; k < 200'000; ++k) {
      // Drawn back towards where the limits are, so that it crosses them often.
      const Vec3 pull = (at(500, 500, 175) - p) * 0.002;
      v = 0.99 * v + pull + Vec3(random.normal(), random.normal(), random.normal());
      p += 0.1 * v;
      const bool floor = k / 1000 % 2 != 0;
      const double clearance = look_ahead > 0
                                   ? std::min(fence.clearance(p, floor),
                                              fence.clearance(p + look_ahead * v, floor))
                                   : fence.clearance(p, floor);
      const bool now = clearance <= (outside ? options.hysteresis : 0);
      crossings += now != outside;
      outside = now;
      ASSERT_EQ(watch.step(p, v, floor), outside) << k;
    }
    EXPECT_GT(crossings, 100);
  }
}

}  // namespace
}  // namespace skein::autopilot::geofence_test
