// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/date_column.h"

#include <gtest/gtest.h>

namespace skein::environment::date_column_test {
namespace {

using Texts = std::vector<std::string>;

struct ReadColumn {
  std::vector<std::string> utc;  // "" for none, seconds as they are
  std::string understood;
  DateColumn column;
};

ReadColumn read(const Texts& texts, const DateColumnOptions& options = {}) {
  ReadColumn result;
  result.column = read_date_column(texts, "DATE", options);
  for (const auto& time : result.column.times)
    result.utc.push_back(!time       ? ""
                         : time->utc ? utc_text(time->value)
                                     : std::to_string(time->value));
  for (const std::string& each : result.column.understood)
    result.understood += each + "; ";
  return result;
}

TEST(DateColumns, TakeTheOrderThatAValueAboveTwelveShows) {
  const ReadColumn read_in = read({"5/9/2021", "25/9/2021"});
  EXPECT_EQ(read_in.utc, (Texts{"2021-09-05T00:00:00Z", "2021-09-25T00:00:00Z"}));
  EXPECT_EQ(read_in.understood,
            "in DATE the day stands before the month, as \"25/9/2021\" shows; ");
  EXPECT_EQ(read({"8/14/21", "8/15/21"}).utc,
            (Texts{"2021-08-14T00:00:00Z", "2021-08-15T00:00:00Z"}));
}

TEST(DateColumns, ElseTakeTheOrderInWhichTimesLieClosest) {
  const ReadColumn read_in = read({"05/09/2021", "06/09/2021", "07/09/2021"});
  EXPECT_EQ(read_in.utc, (Texts{"2021-09-05T00:00:00Z", "2021-09-06T00:00:00Z",
                                "2021-09-07T00:00:00Z"}));
  EXPECT_NE(read_in.understood.find("lie closest together (else give date_order)"),
            std::string::npos)
      << read_in.understood;
  EXPECT_EQ(read({"9/5/21", "9/6/21"}).utc,
            (Texts{"2021-09-05T00:00:00Z", "2021-09-06T00:00:00Z"}));
  EXPECT_EQ(read({"21/09/05", "21/09/06"}).utc,
            (Texts{"2021-09-05T00:00:00Z", "2021-09-06T00:00:00Z"}));
  EXPECT_NE(read({"9/5/21"}).understood.find("1969 to 2068"), std::string::npos);
}

TEST(DateColumns, TakeTheOrderThatIsGiven) {
  EXPECT_EQ(read({"5/9/2021", "6/9/2021"}, {.order = DateOrder::kMonthFirst}).utc,
            (Texts{"2021-05-09T00:00:00Z", "2021-06-09T00:00:00Z"}));
  EXPECT_EQ(read({"25/9/2021"}, {.order = DateOrder::kMonthFirst}).column.wrong, 0u);
}

TEST(DateColumns, WhatMeansNoneIsNone) {
  const Texts none = {"",
                      "null",
                      "N/A",
                      "0000-00-00",
                      "-2209161600000",
                      "0",
                      "-1",
                      "1970-01-01T00:00:00Z",
                      "1969-12-31 16:00",
                      "9999-12-31T00:00:00Z",
                      "253402300799000",
                      "1900-01-01",
                      "0001-01-01T00:00:00"};
  for (const std::string& each : none) {
    const ReadColumn read_in = read({"2021-09-05", each});
    EXPECT_EQ(read_in.utc[1], "") << each;
    EXPECT_EQ(read_in.column.wrong, std::nullopt) << each;
  }
  const ReadColumn counted = read({"1630839600000", "0", "-2209161600000"});
  EXPECT_EQ(counted.column.null_count, 2u);
  EXPECT_EQ(counted.column.first_null, "0");
  // Plain seconds begin where they want.
  EXPECT_EQ(read({"0", "60"}).utc, (Texts{"0.000000", "60.000000"}));
}

TEST(DateColumns, NumbersMayBeDaysOfASpreadsheet) {
  const ReadColumn days = read({"44444.9166666667", "44445"});
  EXPECT_EQ(days.utc, (Texts{"2021-09-05T22:00:00Z", "2021-09-06T00:00:00Z"}));
  EXPECT_NE(days.understood.find("days of a spreadsheet"), std::string::npos);
  EXPECT_EQ(read({"2021248", "2021249"}).utc,
            (Texts{"2021-09-05T00:00:00Z", "2021-09-06T00:00:00Z"}));
  EXPECT_FALSE(read({"44444", "44445"}, {.plain_seconds = true}).column.times[0]->utc);
  EXPECT_FALSE(read({"0", "44444"}).column.times[1]->utc);
}

TEST(DateColumns, SayWhatIsNoTime) {
  const ReadColumn read_in = read({"2021-09-05", "soon", "later"});
  EXPECT_EQ(read_in.column.wrong, 1u);
  EXPECT_EQ(read_in.column.wrong_count, 2u);
}

}  // namespace
}  // namespace skein::environment::date_column_test
