// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/unit_words.h"

#include <gtest/gtest.h>

namespace skein::geo::unit_words_test {
namespace {

TEST(UnitWords, OfLength) {
  for (const char* metre : {"m", "metre", "Meters", "[m]", "M"})
    EXPECT_EQ(length_unit(metre), 1.0) << metre;
  for (const char* foot : {"ft", "foot", "Feet", "international foot"})
    EXPECT_EQ(length_unit(foot), 0.3048) << foot;
  for (const char* foot :
       {"US survey foot", "ftUS", "us-ft", "Foot_US", "US Survey Feet"})
    EXPECT_EQ(length_unit(foot), 1200.0 / 3937) << foot;
  for (const char* other : {"", "hPa", "1", "degrees", "m/s", "furlong"})
    EXPECT_FALSE(length_unit(other)) << other;
}

TEST(UnitWords, OfSpeed) {
  for (const char* word : {"m/s", "m s-1", "m s**-1", "m.s^-1", "ms-1", "[m/s]", "mps",
                           "meters/second", "metres per second", "M/S"})
    EXPECT_EQ(speed_unit(word), 1.0) << word;
  for (const char* word : {"kt", "Knots", "kts", "kn"})
    EXPECT_DOUBLE_EQ(*speed_unit(word), 1852.0 / 3600) << word;
  for (const char* word : {"mph", "mi/h", "miles per hour", "mile hour-1"})
    EXPECT_DOUBLE_EQ(*speed_unit(word), 0.44704) << word;
  for (const char* word : {"km/h", "kph", "km h-1", "km hr**-1"})
    EXPECT_DOUBLE_EQ(*speed_unit(word), 1 / 3.6) << word;
  EXPECT_DOUBLE_EQ(*speed_unit("ft/min"), 0.3048 / 60);
  for (const char* other : {"", "m", "beaufort", "m s-2", "kg m-1", "/", "-1"})
    EXPECT_FALSE(speed_unit(other)) << other;
}

TEST(UnitWords, OfTime) {
  EXPECT_EQ(time_unit("s"), 1.0);
  EXPECT_EQ(time_unit("Minutes"), 60.0);
  EXPECT_EQ(time_unit("hours"), 3600.0);
  EXPECT_EQ(time_unit("days"), 86400.0);
  EXPECT_FALSE(time_unit("months"));
}

}  // namespace
}  // namespace skein::geo::unit_words_test
