// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "skein/geo/vec.h"
#include "skein/scenario/parse.h"
#include "skein/scenario/test/fake_kinds.h"
#include "skein/scenario/test/reading.h"

namespace skein::scenario::test::read_test {
namespace {

const FakeOptions& radio_of(const Scenario& scenario) {
  return scenario.radio.as<FakeOptions>();
}

TEST(Read, GivesEveryDefaultToAThreeLineScenario) {
  const Scenario s = read_good("name: short\nseed: 7\nduration_s: 60\n");
  EXPECT_EQ(s.name, "short");
  EXPECT_EQ(s.seed, 7u);
  EXPECT_EQ(s.duration, Time::from_seconds(60));
  EXPECT_EQ(s.step, Scenario{}.step);
  ASSERT_EQ(s.aircraft.size(), 1u);
  EXPECT_EQ(s.aircraft[0].plant.as<FakeOptions>().airspeed, 20);
  EXPECT_EQ(s.aircraft[0].sensors.size(), AircraftGroup{}.sensors.size());
}

TEST(Read, TakesARunWithoutAircraftButNotOneWithoutTime) {
  EXPECT_TRUE(read_good("aircraft: []\n").aircraft.empty());
  EXPECT_EQ(problems_of("duration_s: 0"),
            "test.yaml:1:13 duration_s: 0 must be above 0 and at most 4000000. The "
            "default is 3600.\n");
}

TEST(Read, TakesEveryTypeOfKey) {
  const Scenario s = read_good(R"(
radio:
  kind: joint
  airspeed_mps: 2.5e1
  bank_deg: 45
  timeout_s: 0.1
  delay_s: +.5
  harmonics: 0
  robust: false
  label: 12
  colour: green
  method: euler
  drift_mps: [-1, 2]
  map: CMakeLists.txt
  gains: [0, 1e3]
  points_m: [[1, 2], [3, 4]]
  layers:
    - {height_m: 50}
    - speed_mps: 9
  limit_m: 4
  extra: {}
  courses_deg: []
)");
  FakeOptions requested;
  requested.airspeed = 25;
  requested.bank = geo::radians(45);
  requested.timeout = Time::from_ns(100'000'000);
  requested.delay = 0.5;
  requested.harmonics = 0;
  requested.robust = false;
  requested.label = "12";
  requested.colour = "green";
  requested.method = Method::kEuler;
  requested.drift = {-1, 2};
  requested.map =
      (std::filesystem::path(SKEIN_SOURCE_DIR) / "CMakeLists.txt").lexically_normal();
  requested.gains = {0, 1000};
  requested.points = {{1, 2}, {3, 4}};
  requested.layers = {{50, 1}, {10, 9}};
  requested.limit = 4;
  requested.extra = Layer{};
  requested.courses = {};
  EXPECT_EQ(radio_of(s), requested);
}

TEST(Read, TakesAKindByItsNameAlone) {
  const Scenario s = read_good("radio: qkf\nenvironment: {wind: uniform}");
  EXPECT_EQ(s.radio.as<QkfOptions>().gain, 1);
  EXPECT_NO_THROW(s.environment.wind.as<NoOptions>());
  EXPECT_THROW(s.environment.wind.as<QkfOptions>(), Bug);
}

TEST(Read, TakesAnchorsAndAliases) {
  const Scenario s = read_good(
      "aircraft:\n"
      "  - {count: 2, start: &start {distance_m: 300}}\n"
      "  - {count: 3, start: *start}\n");
  EXPECT_EQ(s.aircraft.at(1).start.distance, 300);
}

TEST(Read, ReportsAllProblemsAtOnceInTheOrderOfTheirPlaces) {
  EXPECT_EQ(
      problems_of("environment:\n"
                  "  terrain: {kind: joint, airspeed_mps: -1.2}\n"
                  "  tarrain: gus-rate\n"
                  "aircraft:\n"
                  "  - count: two\n"
                  "  - plant:\n"
                  "      kind: kinematic\n"
                  "      harmonics: 31\n"),
      "test.yaml:2:40 environment.terrain.airspeed_mps: -1.2 must be above 0 and at "
      "most 100. The default is 20.\n"
      "test.yaml:3:3 environment.tarrain: unknown key. Did you mean \"terrain\"?\n"
      "test.yaml:5:12 aircraft[0].count: found \"two\", needs a whole number from 0 "
      "to 10000. The default is 1.\n"
      "test.yaml:8:18 aircraft[1].plant.harmonics: 31 must be from 0 to 30. The "
      "default is 5.\n");
}

TEST(Read, CountsProblems) {
  EXPECT_TRUE(read_text("nam: x").report().ends_with("\n1 problem; nothing was run.\n"));
  EXPECT_TRUE(read_text("nam: x\nsede: 1")
                  .report()
                  .ends_with("\n2 problems; nothing was run.\n"));
}

struct Case {
  const char* text;
  const char* problem;
};

TEST(Read, ConditionsBetweenKeysAreReportedWithEverythingElse) {
  // The key where it is written, else the one it does not go with; nothing that rests on
  // a value which is wrong itself.
  EXPECT_EQ(
      problems_of("duration_s: -1\n"
                  "environment: {period_s: 0.25}\n"
                  "aircraft:\n"
                  "  - {agent_period_s: 0.25, count: many}\n"
                  "  - {agent_period_s: soon}\n"
                  "record: {rate_hz: 3.33333}\n"),
      "test.yaml:1:13 duration_s: -1 must be above 0 and at most 4000000. The default "
      "is 3600.\n"
      "test.yaml:2:15 environment.period_s: 0.25 s is no whole number of steps of "
      "0.1 s (step_s); the nearest is 0.3.\n"
      "test.yaml:4:6 aircraft[0].agent_period_s: 0.25 s is no whole number of steps "
      "of 0.1 s (step_s); the nearest is 0.3.\n"
      "test.yaml:4:35 aircraft[0].count: found \"many\", needs a whole number from 0 "
      "to 10000. The default is 1.\n"
      "test.yaml:5:22 aircraft[1].agent_period_s: found \"soon\", needs a number "
      "from 0.001 to 3600.\n");
  EXPECT_EQ(problems_of("seed: 1\nstep_s: 0.3\nrecord: {rate_hz: 3.33333, "
                        "metrics_period_s: 3}\nstations: [{agent_period_s: 0.3}]\n"
                        "aircraft: []\nenvironment: {period_s: 0.9}"),
            "");
  EXPECT_EQ(
      problems_of("step_s: 0.3\naircraft: []\nrecord: {rate_hz: 3.33333, "
                  "metrics_period_s: 3}"),
      "test.yaml:1:1 stations[0].agent_period_s: 0.5 s is no whole number of steps of "
      "0.3 s (step_s); the nearest is 0.6.\n");
  EXPECT_EQ(problems_of("step_s: fast\nenvironment: {period_s: 0.25}"),
            "test.yaml:1:9 step_s: found \"fast\", needs a number from 0.001 to 10.\n");
  EXPECT_EQ(problems_of("name: x", {"aircraft[0].agent_period_s=0.25"}),
            "--set aircraft[0].agent_period_s=0.25 aircraft[0].agent_period_s: 0.25 s "
            "is no whole number of steps of 0.1 s (step_s); the nearest is 0.3.\n");
}

TEST(Read, ConditionsAreAskedOnlyOfValuesThatWereRead) {
  // As 0 in the place of the step it would be a division by zero.
  for (const char* nothing : {"", "''", "'0'", "soon", "0", "-1", ".nan", "[]"}) {
    const std::string set = std::string("aircraft[0].flight_step_s=") + nothing;
    const ReadOutcome outcome = read_text("name: x", {set});
    EXPECT_EQ(outcome.problem_count, *nothing == '\0' ? 0u : 1u) << outcome.report();
  }
  EXPECT_EQ(problems_of("name: x", {"step_s=''", "aircraft[0].flight_step_s=0.03"}),
            "--set step_s='' step_s: found the text \"\", needs a number from 0.001 to "
            "10.\n");
}

class ReadRefuses : public testing::TestWithParam<Case> {};

TEST_P(ReadRefuses, WithOneMessage) {
  EXPECT_EQ(problems_of(GetParam().text), std::string(GetParam().problem) + "\n");
}

// Keys, kinds, values, files, rules, syntax.
INSTANTIATE_TEST_SUITE_P(
    All, ReadRefuses,
    testing::Values(
        Case{"origin: {frobnicate: 1}",
             "test.yaml:1:10 origin.frobnicate: unknown key. Known here: latitude_deg, "
             "longitude_deg."},
        Case{
            "duration_min: 90",
            "test.yaml:1:1 duration_min: unknown key. The unit here is s, not min: write "
            "\"duration_s: 5400\"."},
        Case{"duration: 90",
             "test.yaml:1:1 duration: unknown key. The key is \"duration_s\", in s."},
        Case{"duration_kg: 90",
             "test.yaml:1:1 duration_kg: unknown key. The key is \"duration_s\", in s, "
             "not "
             "kg."},
        Case{"seed_m: 90",
             "test.yaml:1:1 seed_m: unknown key. The key is \"seed\", without a unit."},
        Case{"radio: {kind: joint, airspeed_kmh: 72}",
             "test.yaml:1:22 radio.airspeed_kmh: unknown key. The unit "
             "here "
             "is m/s, not km/h: write \"airspeed_mps: 20\"."},
        Case{
            "seed: 1\nseed: 2",
            "test.yaml:2:1: the key \"seed\" stands here a second time; first in line 1. "
            "Remove one of the two."},
        Case{"? [a]\n: 1\nname: x", "test.yaml:1:3: a key must be a word."},
        Case{"radio: joitn",
             "test.yaml:1:8 radio: unknown kind of radio: \"joitn\". "
             "Did you mean \"joint\"? Kinds: joint, qkf or ideal."},
        Case{"radio: {gain: 2}",
             "test.yaml:1:8 radio: has no \"kind\". Kinds: joint, qkf or "
             "ideal."},
        Case{"radio: [qkf]",
             "test.yaml:1:8 radio: found a list, needs the name of a kind "
             "of radio, or its keys with \"kind\". Kinds: joint, qkf or ideal."},
        Case{"radio: {kind: qkf, harmonics: 2}",
             "test.yaml:1:20 radio.harmonics: unknown key. The kind "
             "\"joint\" has it, \"qkf\" has not."},
        Case{"environment: {phenomena: [{kind: thesis, speed: 2}]}",
             "test.yaml:1:42 environment.phenomena[0].speed: unknown key. Known here: "
             "kind."},
        Case{"duration_s: \"60\"",
             "test.yaml:1:13 duration_s: found the text \"60\", needs a number above 0 "
             "and at most 4000000. Remove the quotation marks."},
        Case{"duration_s: 60 min",
             "test.yaml:1:13 duration_s: found \"60 min\", needs a number above 0 "
             "and at most 4000000. "
             "Write the number alone; the key says the unit, s."},
        Case{"duration_s: .nan",
             "test.yaml:1:13 duration_s: .nan must be a finite number. The default is "
             "3600."},
        Case{"duration_s: -.inf",
             "test.yaml:1:13 duration_s: -.inf must be a finite number. The default is "
             "3600."},
        Case{"duration_s: 1e999",
             "test.yaml:1:13 duration_s: found \"1e999\", needs a number above 0 "
             "and at most 4000000. "
             "Write the number alone; the key says the unit, s."},
        Case{
            "duration_s:",
            "test.yaml:1:1 duration_s: found nothing, needs a number above 0 and at most "
            "4000000."},
        Case{"duration_s: {}",
             "test.yaml:1:13 duration_s: found keys with values, needs a number above 0 "
             "and at most 4000000."},
        Case{"seed: 1.5",
             "test.yaml:1:7 seed: found 1.5, needs a whole number at least 0. The "
             "default is 1."},
        Case{"record: {messages: yes}",
             "test.yaml:1:20 record.messages: found \"yes\", needs true or false."},
        Case{"name: [x]", "test.yaml:1:7 name: found a list, needs text."},
        Case{
            "start_utc: 2026-02-30T00:00:00Z",
            "test.yaml:1:12 start_utc: found \"2026-02-30T00:00:00Z\", needs a moment as "
            "2026-07-01T12:00:00Z. The default is \"2026-07-01T12:00:00Z\"."},
        Case{
            "aircraft: [{start: {placement: rign}}]",
            "test.yaml:1:32 aircraft[0].start.placement: found \"rign\", needs opposite, "
            "ring, line or list. Did you mean \"ring\"?"},
        Case{"stations: [{position_m: [1, 2, 3]}]",
             "test.yaml:1:25 stations[0].position_m: found a list, needs [north, east], "
             "a latitude and longitude or a feature. "
             "It "
             "has "
             "3 elements."},
        Case{"stations: [{position_m: [1, x]}]",
             "test.yaml:1:29 stations[0].position_m: found \"x\", needs [north, east], a "
             "latitude and longitude or a feature."},
        Case{"origin: 3", "test.yaml:1:9 origin: found 3, needs keys with values."},
        Case{"environment: {zones_m: [[[0, 0], [1, 1]]]}",
             "test.yaml:1:25 environment.zones_m[0]: 2 elements; needs a list, at least "
             "3, "
             "each [north, east], a latitude and longitude or a feature."},
        Case{"radio: {kind: joint, map: no.tif}",
             "test.yaml:1:27 radio.map: \"" SKEIN_SOURCE_DIR "/no.tif\" does not exist."},
        Case{"radio: {kind: joint, map: src}",
             "test.yaml:1:27 radio.map: \"" SKEIN_SOURCE_DIR "/src\" is a folder."},
        Case{"aircraft: [{failures: [{kind: land}]}]",
             "test.yaml:1:24 aircraft[0].failures[0].at_s: is missing; needs a number "
             "from 0 "
             "to 4000000."},
        Case{"aircraft: [{failures: [{at_s: 5, aircraft: 1}]}]",
             "test.yaml:1:13 aircraft[0].failures: aircraft 1 of a group of 1; they are "
             "counted from 0."},
        Case{"aircraft: [{return_s: 5}]",
             "test.yaml:1:13 aircraft[0].return_s: needs leave_s, which is not given."},
        Case{"aircraft: [{count: 2, start: {placement: list, positions_m: [[0, 0]]}}]",
             "test.yaml:1:23 aircraft[0].start: 1 positions_m for 2 aircraft; needs one "
             "each."},
        Case{"record: {rate_hz: 7}",
             "test.yaml:1:10 record.rate_hz: 7 rows a second are not one every whole "
             "number of steps of 0.1 s (step_s); the nearest is 10."},
        Case{"step_s: 0.25\nrecord: {rate_hz: 4}\nstations: [{agent_period_s: 0.3}]",
             "test.yaml:3:13 stations[0].agent_period_s: 0.3 s is no whole number of "
             "steps of "
             "0.25 s (step_s); the nearest is 0.25."},
        Case{"[1, 2]", "test.yaml:1:1: a scenario is a list of keys, as in \"name: x\"."},
        Case{"",
             "test.yaml:1:1: the file is empty. Give it a key, as in \"name: "
             "first-flight\"; all have defaults."},
        Case{"# nothing\n",
             "test.yaml:1:1: the file is empty. Give it a key, as in \"name: "
             "first-flight\"; all have defaults."},
        Case{"name: x\n---\nname: y",
             "test.yaml:3:1: a second document starts here; a scenario is one document."},
        Case{"name: !!str x",
             "test.yaml:1:7: the tag \"tag:yaml.org,2002:str\" is not used "
             "here."},
        Case{"name: [1", "test.yaml:1:1: not YAML: end of sequence flow not found."},
        Case{"record:\n\trate_hz: 5",
             "test.yaml:2:9: not YAML: illegal map value. The line is indented with a "
             "tab; "
             "use spaces."},
        Case{"name: \"\\0\"",
             "test.yaml:1:7: \"\\x00\" holds a control character or is not UTF-8."},
        Case{"name: x\nseed: \xFF",
             "test.yaml:2:7: byte 0xff is not text. A scenario is a YAML file in UTF-8."},
        Case{"name: \x01",
             "test.yaml:1:7: byte 0x01 is not text. A scenario is a YAML file in UTF-8."},
        Case{"name: &a [*a]",
             "test.yaml:1:11: the alias stands inside the value that it refers to."}));

TEST(Read, NamesTheFileHoweverDeepItLies) {
  const std::string folder(70, 'f');
  const std::string deep = folder + "/" + folder + "/" + folder + "/no-such.tif";
  EXPECT_NE(problems_of("radio: {kind: joint, map: " + deep + "}").find(deep),
            std::string::npos);
  std::string deeper;
  for (int i = 0; i < 300; ++i) deeper += "\u00e4/";
  EXPECT_NE(problems_of("radio: {kind: joint, map: " + deeper + "no-such.tif}")
                .find("\".../\u00e4/\u00e4/"),
            std::string::npos);
}

TEST(Read, SurvivesHostileFiles) {
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int j = 0; j < 10; ++j) bomb += "*a" + std::to_string(i - 1) + ", ";
    bomb += "]\n";
  }
  EXPECT_NE(problems_of(bomb).find("anchors and aliases repeat"), std::string::npos);
  for (const char* open : {"[", "{a: ", "- ", "? ", "&a [", "a: {"}) {
    std::string deep;
    for (int i = 0; i < 50000; ++i) deep += open;
    EXPECT_NE(problems_of(deep), "") << open;
  }
}

TEST(Read, AnswersToTenMegabytes) {
  std::string list = "aircraft:\n  - start:\n      positions_m: [";
  while (list.size() < 10'000'000) list += "[1234.5, -678.9],\n       ";
  const ReadOutcome good = read_text(list + "[0, 1]]\n");
  ASSERT_EQ(good.report(), "");
  EXPECT_GE(good.scenario->aircraft.at(0).start.positions.size(), 400000u);

  std::string nonsense;
  for (int i = 0; nonsense.size() < 10'000'000; ++i) {
    nonsense += "unknown_key_" + std::to_string(i) + ": 1\n";
  }
  const ReadOutcome bad = read_text(nonsense);
  EXPECT_EQ(bad.problems.size(), Problems::kMax);
  EXPECT_GT(bad.problem_count, 400000u);
}

TEST(Read, RefusesMoreThanTwentyMegabytes) {
  const std::string text(ParseLimits::kBytes + 1, '#');
  EXPECT_EQ(problems_of(text), "test.yaml: 20000001 bytes; at most 20000000 are read.\n");
}

TEST(ReadFile, NamesWhatCannotBeRead) {
  const auto folder = std::filesystem::temp_directory_path();
  const KindTable kinds = fake_kinds();
  EXPECT_EQ(read_scenario(folder / "no-such.yaml", kinds).problems.at(0).text(),
            (folder / "no-such.yaml").string() + ": there is no such file.");
  EXPECT_EQ(read_scenario(folder, kinds).problems.at(0).text(),
            folder.string() + ": is a folder, not a scenario file.");
}

TEST(ReadFile, FindsFilesBesideTheScenario) {
  const auto folder = std::filesystem::temp_directory_path() / "skein-scenario-test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "map.txt") << "x";
  std::ofstream(folder / "a.yaml") << "radio: {kind: joint, map: ./map.txt}\n";
  const ReadOutcome outcome = read_scenario(folder / "a.yaml", fake_kinds());
  ASSERT_EQ(outcome.report(), "");
  EXPECT_EQ(radio_of(*outcome.scenario).map, (folder / "map.txt").string());
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace skein::scenario::test::read_test
