// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/routine_periods.h"

#include <gtest/gtest.h>

#include <string>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/radio/radio_parts.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::routine_periods_test {
namespace {

scenario::Scenario scenario_with(const std::string& radio, int aircraft,
                                 const std::string& more = "") {
  auto read = scenario::read_scenario_text(
      "duration_s: 120\nenvironment: {phenomena: []}\nmissions: []\nradio: " + radio +
          "\naircraft: [{count: " + std::to_string(aircraft) +
          ", agent: {kind: scout, avoidance: {method: auto}}}]\n" + more,
      "test", ".", kind_table());
  EXPECT_TRUE(read.ok()) << read.report();
  return *read.scenario;
}

RoutinePeriods periods_of(const scenario::Scenario& scenario) {
  return routine_periods(scenario, own_radio_parts());
}

TEST(RoutinePeriods, AreASecondWhereTheRadioHasRoom) {
  for (const char* radio :
       {"ideal", "{kind: medium, profile: wifi-dsss-2}", "{kind: medium, profile: n920}",
        "{kind: medium, profile: satcom}"}) {
    const RoutinePeriods periods = periods_of(scenario_with(radio, 10));
    EXPECT_EQ(periods.query, 1) << radio;
    EXPECT_EQ(periods.place, 1) << radio;
  }
}

TEST(RoutinePeriods, GrowWithTheAircraftOfANarrowRadio) {
  const char* narrow = "{kind: medium, profile: xbee-digimesh}";
  EXPECT_EQ(periods_of(scenario_with(narrow, 1)).place, 1);
  // 8 * 223 bit/s of each in 0.2 of 10 kbit/s.
  EXPECT_NEAR(periods_of(scenario_with(narrow, 5)).place, 4.46, 1e-9);
  const RoutinePeriods ten = periods_of(scenario_with(narrow, 10));
  EXPECT_EQ(ten.place, 5);
  EXPECT_NEAR(ten.query, 8.92, 1e-9);
  const RoutinePeriods many = periods_of(scenario_with(narrow, 100));
  EXPECT_EQ(many.place, 5);
  EXPECT_EQ(many.query, 20);
}

}  // namespace
}  // namespace skein::assemble::routine_periods_test
