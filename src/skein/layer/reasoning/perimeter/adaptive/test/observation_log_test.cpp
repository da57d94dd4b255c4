// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/adaptive/observation_log.h"

#include <gtest/gtest.h>

namespace skein::perimeter::observation_log_test {
namespace {

Observation reading(int second) {
  return FireReading{Time::from_seconds(second), {0}, {1.0 * second, 0}, 1, true};
}

TEST(ObservationLog, KeepsOrderAndCopiesGoTheirOwnWay) {
  ObservationLog log;
  for (int i = 0; i < 1500; ++i) log.add(reading(i));
  ObservationLog copy = log;
  log.add(reading(1500));
  copy.add(reading(9000));
  ASSERT_EQ(log.size(), 1501U);
  ASSERT_EQ(copy.size(), 1501U);
  for (const std::size_t i : {0UL, 511UL, 512UL, 1499UL, 1500UL})
    EXPECT_EQ(std::get<FireReading>(log.at(i)).point.x(), static_cast<double>(i));
  EXPECT_EQ(std::get<FireReading>(copy.at(1500)).point.x(), 9000);
}

}  // namespace
}  // namespace skein::perimeter::observation_log_test
