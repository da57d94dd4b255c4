// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/zones.h"

#include <gtest/gtest.h>

#include "skein/scenario/test/fake_kinds.h"
#include "skein/scenario/test/reading.h"
#include "skein/scenario/write.h"

namespace skein::scenario::zones_test {
namespace {

using test::problems_of;
using test::read_good;

TEST(Zones, AreReadWithLimitsAndSwitches) {
  const Scenario s = read_good(
      "environment:\n"
      "  zones_m: [[[0, 0], [100, 0], [100, 100]]]\n"
      "  zones:\n"
      "    - {name: school, centre_m: [200, 300], radius_m: 50, floor_msl_m: 0,\n"
      "       ceiling_msl_m: 120, from_s: 10, until_s: 20}\n"
      "    - {name: fire-line, ring_m: [[0, 0], [0, 9], [9, 9]], active: false,\n"
      "       switches: [{at_s: 5}, {at_s: 9, on: false}]}\n");
  ASSERT_EQ(s.environment.zones.size(), 2u);
  const Zone school = to_zone(s.environment.zones[0]);
  EXPECT_EQ(school.name, "school");
  EXPECT_EQ(std::get<Disc>(school.area).centre, Vec2(200, 300));
  EXPECT_EQ(std::get<Disc>(school.area).radius, 50);
  EXPECT_EQ(school.floor_msl, 0);
  EXPECT_EQ(school.ceiling_msl, 120);
  EXPECT_EQ(school.from, 10);
  EXPECT_EQ(school.until, 20);
  const NoFlightZone& line = s.environment.zones[1];
  EXPECT_FALSE(line.active);
  ASSERT_EQ(line.switches.size(), 2u);
  EXPECT_TRUE(line.switches[0].on);
  EXPECT_EQ(line.switches[1].at, Time::from_seconds(9));
  EXPECT_GT(geo::signed_area(std::get<geo::Ring>(to_zone(line).area)), 0);  // turned
  EXPECT_EQ(ring_zone(s.environment.zone_rings[0], 0).name, "zones_m[0]");
  const std::string text = write_scenario(s, test::fake_kinds());
  EXPECT_EQ(write_scenario(read_good(text), test::fake_kinds()), text);
}

struct Case {
  std::string zone, problem;
};

TEST(Zones, AreRefusedWithTheReason) {
  for (const Case& c : {
           Case{"{ring_m: [[0, 0], [1, 0], [1, 1]]}", "zones[0].name"},
           Case{"{name: '', ring_m: [[0, 0], [1, 0], [1, 1]]}", "must not be empty"},
           Case{"{name: a}", "needs ring_m, or centre_m and radius_m"},
           Case{"{name: a, centre_m: [0, 0]}", "needs ring_m, or centre_m and radius_m"},
           Case{"{name: a, centre_m: [0, 0], radius_m: 5, ring_m: [[0, 0], [1, 0], [1, "
                "1]]}",
                "not both"},
           Case{"{name: a, centre_m: [0, 0], radius_m: 0}", "radius_m"},
           Case{"{name: a, centre_m: [0, .nan], radius_m: 5}", "centre_m"},
           Case{"{name: a, ring_m: [[0, 0], [10, 10], [10, 0], [0, 10]]}",
                "crosses itself at 5.0 m north, 5.0 m east"},
           Case{"{name: a, ring_m: [[0, 0], [10, 0], [20, 0]]}", "no area"},
           Case{"{name: a, centre_m: [0, 0], radius_m: 5, floor_msl_m: 50, "
                "ceiling_msl_m: 50}",
                "ceiling_msl_m: must be above floor_msl_m"},
           Case{"{name: a, centre_m: [0, 0], radius_m: 5, from_s: 50, until_s: 49}",
                "until_s: must be after from_s"},
           Case{"{name: a, centre_m: [0, 0], radius_m: 5, switches: [{at_s: 5}]}",
                "changes nothing: the zone is in force already"},
           Case{"{name: a, centre_m: [0, 0], radius_m: 5, switches: [{at_s: 5, on: "
                "false}, {at_s: 5}]}",
                "at_s must grow"},
           Case{"{name: a, centre_m: [0, 0], radius_m: 5}, {name: a, centre_m: [9, 9], "
                "radius_m: 5}",
                "another zone is called \"a\" already"},
       }) {
    const std::string found = problems_of("environment: {zones: [" + c.zone + "]}");
    EXPECT_NE(found.find(c.problem), std::string::npos) << c.zone << "\n" << found;
  }
}

TEST(Zones, OfTheShortKindAreRefusedWhenTheyCrossThemselves) {
  const std::string found =
      problems_of("environment: {zones_m: [[[0, 0], [10, 10], [10, 0], [0, 10]]]}");
  EXPECT_NE(found.find("environment.zones_m[0]: cannot be used: its ring crosses itself"),
            std::string::npos)
      << found;
}

TEST(Zones, ThatRunCounterClockwiseGiveAWarningAndAreNotRefused) {
  const Scenario s = read_good(
      "environment:\n"
      "  zones_m: [[[0, 0], [0, 9], [9, 9]], [[0, 0], [9, 0], [9, 9]]]\n"
      "  zones: [{name: b, ring_m: [[0, 0], [0, 9], [9, 9]]}]\n");
  const std::vector<std::string> warnings = zone_warnings(s.environment);
  // Clockwise on the map is north, then east: one of the two short ones is not.
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("zones_m["), std::string::npos);
  EXPECT_NE(warnings[1].find("zone b"), std::string::npos);
}

}  // namespace
}  // namespace skein::scenario::zones_test
