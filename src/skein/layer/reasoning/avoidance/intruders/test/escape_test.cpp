// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/intruders/escape.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace skein::reasoning::escape_test {
namespace {

constexpr double kNow = 40;

// Where the own aircraft is, flying north at 20 m/s.
const Vec3 kHere(0, 0, -150);
const Vec3 kNorth(20, 0, 0);

AvoidedIntruder from(const Vec3& p_N, const Vec3& v_N) {
  AvoidedIntruder intruder;
  intruder.time = kNow;
  intruder.p_N = p_N;
  intruder.v_N = v_N;
  return intruder;
}

Escape escape(const AvoidedIntruder& intruder) {
  return escape_from(kHere, kNorth, FlightLimits(), {&intruder, 1}, kNow);
}

TEST(Escape, WhoIsOvertakenFastTurnsOutOfTheWay) {
  for (const double side : {1.0, -1.0}) {
    // It passes on the side where the own aircraft is not.
    const Escape found = escape(from(Vec3(-600, -side * 40, -150), Vec3(57, 0, 0)));
    EXPECT_NEAR(found.course, side * geo::kPi / 2, 0.6) << side;
  }
}

TEST(Escape, WhoIsPassedAnywayFliesOn) {
  const Escape found = escape(from(Vec3(0, 3000, -150), Vec3(0, 40, 0)));
  EXPECT_NEAR(found.course, 0, geo::kPi / 2 + 1e-9) << "it turns no more than it helps";
  EXPECT_TRUE(found.up);
}

TEST(Escape, ItClimbsWhereTheIntruderWillBeBelow) {
  EXPECT_TRUE(escape(from(Vec3(800, 0, -130), Vec3(-40, 0, 0))).up);
  EXPECT_FALSE(escape(from(Vec3(800, 0, -170), Vec3(-40, 0, 0))).up);
  // Below now, above when it is near: in 800 m / 60 m/s it climbs 40 m.
  EXPECT_FALSE(escape(from(Vec3(800, 0, -130), Vec3(-40, 0, -3))).up);
}

TEST(Escape, OfTwoIntrudersNoneIsMet) {
  const std::array intruders = {from(Vec3(500, 300, -150), Vec3(-30, -30, 0)),
                                from(Vec3(500, -300, -150), Vec3(-30, 30, 0))};
  const Escape found = escape_from(kHere, kNorth, FlightLimits(), intruders, kNow);
  EXPECT_GT(std::abs(found.course), geo::kPi / 2) << "back, away from both";
}

}  // namespace
}  // namespace skein::reasoning::escape_test
