// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/load_meter.h"

#include <gtest/gtest.h>

namespace skein::modem::load_meter_test {
namespace {

Time seconds(double s) {
  return Time::from_seconds(s);
}

TEST(LoadMeter, IsTheShareOfTheRateInTheLastSecond) {
  LoadMeter meter(10'000);
  EXPECT_EQ(meter.load(seconds(0)), 0);
  // 50 bytes each tenth of a second are 4 kbit/s.
  for (int k = 0; k < 30; ++k) meter.add(50, seconds(0.05 + 0.1 * k));
  EXPECT_NEAR(meter.load(seconds(3)), 0.4, 1e-12);
  EXPECT_NEAR(meter.load(seconds(3.55)), 0.2, 1e-12) << "half of it is gone";
  EXPECT_EQ(meter.load(seconds(4.2)), 0);
  meter.add(100'000, seconds(5));
  EXPECT_EQ(meter.load(seconds(5.1)), 1) << "more than it carries";
}

TEST(LoadMeter, KnowsNoLoadWithoutARate) {
  LoadMeter meter(0);
  meter.add(1000, seconds(0));
  EXPECT_EQ(meter.load(seconds(0.5)), 0);
}

}  // namespace
}  // namespace skein::modem::load_meter_test
