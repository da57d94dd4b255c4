// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/scenario/test/fake_kinds.h"
#include "skein/scenario/test/reading.h"

namespace skein::scenario::test::override_test {
namespace {

TEST(Override, ReplacesWhatTheFileSays) {
  const Scenario s = read_good("name: x\nseed: 1\naircraft: [{count: 2}, {count: 3}]",
                               {"seed=9", "name=a b", "aircraft[1].count=4"});
  EXPECT_EQ(s.seed, 9u);
  EXPECT_EQ(s.aircraft.at(0).count, 2);
  EXPECT_EQ(s.aircraft.at(1).count, 4);
}

TEST(Override, ChangesTheDefaultWhereTheFileSaysNothing) {
  const Scenario s =
      read_good("name: x",
                {"aircraft[0].count=5", "aircraft[0].plant.airspeed_mps=33",
                 "radio.harmonics=7", "origin.latitude_deg=48", "aircraft[1].name=late"});
  ASSERT_EQ(s.aircraft.size(), 2u);
  EXPECT_EQ(s.aircraft[0].count, 5);
  // The rest of the default group stays.
  EXPECT_EQ(s.aircraft[0].sensors.size(), AircraftGroup{}.sensors.size());
  EXPECT_EQ(s.aircraft[0].plant.as<FakeOptions>().airspeed, 33);
  EXPECT_EQ(s.aircraft[0].plant.as<FakeOptions>().harmonics, FakeOptions{}.harmonics);
  EXPECT_EQ(s.aircraft[1].name, "late");
  EXPECT_EQ(s.radio.as<FakeOptions>().harmonics, 7);
  EXPECT_EQ(s.origin.latitude_deg, 48);
}

TEST(Override, FillsInTheDefaultElementsThatItLeavesAlone) {
  const Scenario s = read_good("name: x", {"aircraft[0].sensors[3]=gnss"});
  ASSERT_EQ(s.aircraft[0].sensors.size(), AircraftGroup{}.sensors.size() + 1);
  for (const Choice& sensor : s.aircraft[0].sensors)
    EXPECT_TRUE(sensor.options.has_value()) << sensor.kind;
}

TEST(Override, SetsKeysOfAKindGivenByNameAlone) {
  const Scenario s = read_good("radio: qkf", {"radio.gain=3"});
  EXPECT_EQ(s.radio.as<QkfOptions>().gain, 3);
}

TEST(Override, TakesListsAndKeysAsValues) {
  const Scenario s = read_good("name: x", {"stations[0].position_m=[1, 2]",
                                           "radio={kind: qkf, gain: 4}", "aircraft=[]"});
  EXPECT_EQ(s.stations.at(0).position, Vec2(1, 2));
  EXPECT_EQ(s.radio.as<QkfOptions>().gain, 4);
  EXPECT_TRUE(s.aircraft.empty());
}

TEST(Override, MendsAProblemOfTheFile) {
  EXPECT_EQ(problems_of("seed: x", {"seed=3"}), "");
}

TEST(Override, ReportsUnknownPathsAndBadValues) {
  EXPECT_EQ(
      problems_of("name: x", {"environment.tarrain=qkf", "seed=-1"}),
      "--set environment.tarrain=qkf environment.tarrain: unknown key. Did you mean "
      "\"terrain\"?\n"
      "--set seed=-1 seed: -1 must be at least 0. The default is 1.\n");
  EXPECT_EQ(
      problems_of("name: x", {"seed=18446744073709551615"}),
      "--set seed=18446744073709551615 seed: 18446744073709551615 must be from 0 to "
      "9223372036854775807. The default is 1.\n");
  EXPECT_EQ(
      problems_of("name: x", {"seed.low=1"}),
      "--set seed.low=1 seed: found keys with values, needs a whole number at least "
      "0. The default is 1.\n");
  EXPECT_EQ(
      problems_of("name: x", {"seed="}),
      "--set seed= seed: found nothing, needs a whole number at least 0. The default "
      "is 1.\n");
}

TEST(Override, ReportsIndexesThatLeadNowhere) {
  const char* text = "aircraft: [{count: 2}]";
  EXPECT_EQ(
      problems_of(text, {"aircraft[2].count=1"}),
      "--set aircraft[2].count=1: the list has 1 elements. Elements are counted from "
      "0.\n");
  EXPECT_EQ(problems_of(text, {"aircraft.count=1"}),
            "--set aircraft.count=1: a list stands here; write an index as in [0].\n");
  EXPECT_EQ(problems_of("seed: 1", {"seed[0]=1"}),
            "--set seed[0]=1: no list stands here for [0].\n");
  EXPECT_EQ(
      problems_of("name: x", {"aircraft[7].count=1"}),
      "--set aircraft[7].count=1 aircraft[7]: the list has 1 elements. Elements are "
      "counted from 0.\n");
}

TEST(Override, ReportsWhatIsNoOverride) {
  for (const char* set : {"seed", "=1", ".seed=1", "seed.=1", "[0]=1", "a[x]=1", "a[=1",
                          "a[]=1", "a[-1]=1", "a[0]b=1", "a[99999999999]=1", "a..b=1"}) {
    EXPECT_EQ(problems_of("name: x", {set}),
              std::string("--set ") + set + ": needs the form key.key[0].key=value.\n");
  }
  EXPECT_EQ(problems_of("name: x", {"name=[1"}),
            "--set name=[1:1:1: not YAML: end of sequence flow not found.\n");
}

}  // namespace
}  // namespace skein::scenario::test::override_test
