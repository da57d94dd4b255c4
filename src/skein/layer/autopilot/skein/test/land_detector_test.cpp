// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/land_detector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::autopilot::land_detector_test {
namespace {

NavState moving(double time, const Vec3& v, double airspeed, double altitude) {
  NavState nav;
  nav.time = Time::from_seconds(time);
  nav.v_N = v;
  nav.airspeed = airspeed;
  nav.p_N.z() = -altitude;
  return nav;
}

FlightLimits wing() {
  FlightLimits limits;
  limits.slowest = 12;
  return limits;
}

FlightLimits rotors() {
  FlightLimits limits;
  limits.slowest = 0;
  return limits;
}

TEST(LandDetector, AWingIsOnTheGroundWhenItIsTooSlowToFlyForASecond) {
  LandDetector detector(wing(), 0, false);
  EXPECT_FALSE(detector.step(moving(0, {3, 0, 0}, 3, 100), 0));
  EXPECT_FALSE(detector.step(moving(0.9, {3, 0, 0}, 3, 100), 0));
  EXPECT_TRUE(detector.step(moving(1, {3, 0, 0}, 3, 100), 0));
  // Standing still over ground against the wind is flying.
  LandDetector hanging(wing(), 0, false);
  for (int k = 0; k < 50; ++k)
    EXPECT_FALSE(hanging.step(moving(0.1 * k, {0, 0, 0}, 14, 100), 0.5));
}

TEST(LandDetector, AWingIsSeenToStandInAWind) {
  LandDetector detector(wing(), 0, false);
  const auto standing = [](double t) {  // with errors of the velocity, and gusts
    return moving(t, {0.5 * std::sin(3 * t), 0.5, 0.2}, 8 + 2 * std::sin(t), 100);
  };
  for (double t = 0; t < 2.9; t += 0.1) EXPECT_FALSE(detector.step(standing(t), 0));
  EXPECT_TRUE(detector.step(standing(3), 0));
  // Gusts that could carry it do not make it fly as long as it stands.
  EXPECT_TRUE(detector.step(moving(4, {0.3, 0, 0}, 13, 100), 0));
  EXPECT_FALSE(detector.step(moving(5, {0, 0, -1.5}, 13, 100.5), 0)) << "but lifted";
}

TEST(LandDetector, AWingTakesOffByItsSpeedOrHeight) {
  LandDetector detector(wing(), 0, true);
  EXPECT_TRUE(detector.step(moving(0, {0, 0, 0}, 0, 100), 0));
  EXPECT_TRUE(detector.step(moving(1, {8, 0, 0}, 8, 100.5), 1));
  EXPECT_FALSE(detector.step(moving(2, {12, 0, 0}, 12, 100.5), 1));
}

TEST(LandDetector, ARotorcraftIsOnTheGroundWhenItIsStillWithLittleThrust) {
  LandDetector detector(rotors(), 0.5, false);
  for (int k = 0; k < 30; ++k)
    EXPECT_FALSE(detector.step(moving(0.1 * k, {0, 0, 0}, 0, 20), 0.5)) << "it hovers";
  EXPECT_FALSE(detector.step(moving(4, {0, 0, 0.1}, 0, 0), 0.1));
  EXPECT_TRUE(detector.step(moving(5, {0, 0, 0}, 0, 0), 0.1));
  EXPECT_TRUE(detector.step(moving(6, {0, 0, 0}, 0, 2), 0.5)) << "within the error";
  EXPECT_FALSE(detector.step(moving(7, {0, 0, -1.5}, 0, 2), 0.5));
}

}  // namespace
}  // namespace skein::autopilot::land_detector_test
