// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/date_time.h"

#include <gtest/gtest.h>

namespace skein::environment::date_time_test {
namespace {

double iso(const char* text) {
  return *parse_utc(text);
}

TEST(DateTimes, AreReadAsAgenciesWriteThem) {
  struct Case {
    const char *text, *utc;
    bool time_of_day, zone;
  };
  const Case cases[] = {
      {"2021-09-05T14:04:00-07:00", "2021-09-05T21:04Z", true, true},
      {"2021-09-05T14:04:00.500Z", "2021-09-05T14:04:00.5Z", true, true},
      {"2021/09/05 14:04:00+00", "2021-09-05T14:04Z", true, true},
      {"2021-09-05 14:04", "2021-09-05T14:04Z", true, false},
      {"2021-09-05", "2021-09-05", false, false},
      {"9/5/2021 2:04:00 PM", "2021-09-05T14:04Z", true, false},
      {"09/05/2021 12:30 AM", "2021-09-05T00:30Z", true, false},
      {"5.9.2021 14:04", "2021-09-05T14:04Z", true, false},
      {"20210905_1404", "2021-09-05T14:04Z", true, false},
      {"20210905140430", "2021-09-05T14:04:30Z", true, false},
      {"20210905", "2021-09-05", false, false},
      {"9/5/21 22:00", "2021-09-05T22:00Z", true, false},
      {"5.9.21", "2021-09-05", false, false},
      {"9/5/2021, 10:00:00\u202fAM", "2021-09-05T10:00Z", true, false},
      {"9/5/2021\u00a02:04 p.m.", "2021-09-05T14:04Z", true, false},
      {"05-Sep-2021 14:04", "2021-09-05T14:04Z", true, false},
      {"05SEP21 1404", "2021-09-05T14:04Z", true, false},
      {"Sept. 5, 2021 2:04 PM", "2021-09-05T14:04Z", true, false},
      {"Sun Sep 05 2021 14:04:00 GMT-0700 (Pacific Daylight Time)", "2021-09-05T21:04Z",
       true, true},
      {"2021-09-05 14:04 PDT", "2021-09-05T21:04Z", true, true},
      {"2021-09-05 14:04 CEST", "2021-09-05T12:04Z", true, true},
      {"2021-09-05T14:04B", "2021-09-05T12:04Z", true, true},
      {"2021-09-05T14:04X", "2021-09-06T01:04Z", true, true},
      {"2021-09-05 14:04 UTC+2", "2021-09-05T12:04Z", true, true},
      {"2021-09-05 14:04:00 -6:00", "2021-09-05T20:04Z", true, true},
      {"2021090514", "2021-09-05T14:00Z", true, false},
      {"1630850640000", "2021-09-05T14:04Z", true, true},
      {"1630850640", "2021-09-05T14:04Z", true, true}};
  for (const Case& each : cases) {
    const auto time = parse_date_or_number(each.text, DateOrder::kMonthFirst, false);
    ASSERT_TRUE(time) << each.text;
    EXPECT_TRUE(time->utc) << each.text;
    EXPECT_NEAR(time->value, iso(each.utc), 1e-6) << each.text;
    EXPECT_EQ(time->time_of_day, each.time_of_day) << each.text;
    EXPECT_EQ(time->zone, each.zone) << each.text;
  }
  const auto day_first = parse_date("5/9/2021 14:04", DateOrder::kDayFirst);
  ASSERT_TRUE(day_first);
  EXPECT_EQ(day_first->value, iso("2021-09-05T14:04Z"));
}

TEST(DateTimes, SmallNumbersAreSecondsOfAnUnknownOrigin) {
  const auto seconds = parse_date_or_number("8340.5", DateOrder::kMonthFirst, false);
  ASSERT_TRUE(seconds);
  EXPECT_FALSE(seconds->utc);
  EXPECT_EQ(seconds->value, 8340.5);
  EXPECT_FALSE(parse_date_or_number("20210905", DateOrder::kMonthFirst, true)->utc);
}

TEST(DateTimes, WhatIsNoDateIsNone) {
  for (const char* text : {"",
                           "noon",
                           "2021-13-05",
                           "2021-02-30",
                           "13/13/2021",
                           "2021-09-05T25:00",
                           "2021-09-05T24:01",
                           "2021-09-05T14:04A",
                           "14:04",
                           "05-09-21",
                           "2021-09",
                           "1e300",
                           "-20210905",
                           "2021-09-05 14:04 IST",
                           "2021-09-05 10:04 P",
                           "5 Septober 2021",
                           "2021-09-05T14:04+15:00",
                           "2021-09-05 14:04 America/Denver",
                           "9/5/2021 13:04 PM",
                           "2021-09-05T14",
                           "99999999",
                           "2021-09-05 noon",
                           "nan"})
    EXPECT_FALSE(parse_date_or_number(text, DateOrder::kMonthFirst, false)
                     .value_or(DateTime{0, false})
                     .utc)
        << text;
}

TEST(DateTimes, AreFoundInNames) {
  const auto found = [](const char* text) {
    const auto time = find_date(text);
    return time ? time->value : -1;
  };
  EXPECT_EQ(found("Bridge_IR_20210905_1404.shp"), iso("2021-09-05T14:04Z"));
  EXPECT_EQ(found("Heat Perimeter 2021-09-05 23:00"), iso("2021-09-05T23:00Z"));
  EXPECT_EQ(found("ir20210905T0204Z_perimeter"), iso("2021-09-05T02:04Z"));
  EXPECT_EQ(found("2021_09_05_perimeter"), iso("2021-09-05"));
  EXPECT_EQ(found("CA-PNF-000123 Dixie"), -1);
  EXPECT_EQ(found("object 2021090599"), -1);
}

TEST(DateTimes, OfIsoAloneReachBackToAnyYear) {
  EXPECT_EQ(parse_utc("1800-01-01T00:00:00Z"), -5364662400.0);  // date -u -d ... +%s
  for (const char* other : {"20210905", "9/5/2021 14:04", "2021/09/05", "5.9.2021"})
    EXPECT_FALSE(parse_utc(other)) << other;
}

TEST(DateTimes, TimesOfDayStandAlone) {
  EXPECT_EQ(parse_time_of_day("14:04"), 50640);
  EXPECT_EQ(parse_time_of_day("1404"), 50640);
  EXPECT_EQ(parse_time_of_day("904"), 9 * 3600 + 240);
  EXPECT_EQ(parse_time_of_day("2:04 pm"), 50640);
  EXPECT_EQ(parse_time_of_day("2504"), std::nullopt);
  EXPECT_EQ(parse_time_of_day("soon"), std::nullopt);
}

TEST(DateTimes, ShortYearsAndNamedZonesAreSaid) {
  const auto time = parse_date("9/5/21 14:04 PDT", DateOrder::kMonthFirst);
  ASSERT_TRUE(time);
  EXPECT_TRUE(time->short_year);
  EXPECT_EQ(time->zone_name, "PDT is UTC-07:00");
  EXPECT_FALSE(parse_date("9/5/2021", DateOrder::kYearFirst));
  EXPECT_EQ(parse_date("21/09/05", DateOrder::kYearFirst)->value, iso("2021-09-05"));
  EXPECT_EQ(parse_date("9/5/69", DateOrder::kMonthFirst)->value, iso("1969-09-05"));
  EXPECT_EQ(utc_text(iso("1969-09-05T14:04Z") + 0.5), "1969-09-05T14:04:00Z");
}

}  // namespace
}  // namespace skein::environment::date_time_test
