// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/motor_watch.h"

#include <gtest/gtest.h>

namespace skein::autopilot::motor_watch_test {
namespace {

Time ms(int count) {
  return Time::from_ns(count * 1'000'000LL);
}

Actuators throttles(double all) {
  Actuators a;
  a.channel.fill(all);
  return a;
}

TEST(MotorWatch, AMotorThatStandsUnderThrottleHasFailed) {
  MotorWatch watch({.idle = 0.1, .delay = 0.3});
  for (int t = 0; t <= 300; t += 10)
    EXPECT_EQ(watch.step(ms(t), 0b1000, throttles(0.5)), 0) << t;
  EXPECT_EQ(watch.step(ms(310), 0b1000, throttles(0.5)), 0b1000);
}

TEST(MotorWatch, AMotorCommandedToIdleMayStand) {
  MotorWatch watch({});
  for (int t = 0; t <= 5000; t += 10)
    EXPECT_EQ(watch.step(ms(t), 0b1000, throttles(0.1)), 0);
}

TEST(MotorWatch, AStartingMotorHasItsTime) {
  MotorWatch watch({.idle = 0.1, .delay = 0.3});
  for (int t = 0; t <= 5000; t += 10) watch.step(ms(t), 1, throttles(0));
  for (int t = 5010; t <= 5300; t += 10)
    EXPECT_EQ(watch.step(ms(t), 1, throttles(0.8)), 0) << t;
  EXPECT_EQ(watch.step(ms(5310), 0, throttles(0.8)), 0);  // it turns
}

TEST(MotorWatch, EachMotorHasItsOwnTime) {
  MotorWatch watch({.idle = 0.1, .delay = 0.3});
  int first = -1, second = -1;
  for (int t = 0; t <= 1000; t += 10) {
    const std::uint8_t standing = t >= 200 ? 0b0101 : 0b0001;
    const std::uint8_t failed = watch.step(ms(t), standing, throttles(0.5));
    if (first < 0 && (failed & 0b0001) != 0) first = t;
    if (second < 0 && (failed & 0b0100) != 0) second = t;
  }
  EXPECT_EQ(first, 310);
  EXPECT_EQ(second, 510);
}

TEST(MotorWatch, AHiccupStartsTheTimeAgain) {
  MotorWatch watch({.idle = 0.1, .delay = 0.3});
  for (int t = 0; t <= 5000; t += 10)
    EXPECT_EQ(watch.step(ms(t), t / 10 % 30 == 0 ? 0 : 2, throttles(0.5)), 0) << t;
}

}  // namespace
}  // namespace skein::autopilot::motor_watch_test
