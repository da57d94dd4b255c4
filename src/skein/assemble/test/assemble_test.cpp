// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/build.h"
#include "skein/assemble/world/placement.h"
#include "skein/assemble/world/presence.h"
#include "skein/assemble/world/run.h"
#include "skein/scenario/scenario_file.h"
#include "skein/simulation/simulated_vehicle.h"

namespace skein::assemble::assemble_test {
namespace {

using scenario::AircraftGroup;
using scenario::Scenario;

// A scenario from text; the test ends when it has problems.
Scenario read(const std::string& text) {
  auto outcome = scenario::read_scenario_text(text, "test", ".", kind_table());
  EXPECT_TRUE(outcome.ok()) << outcome.report();
  Scenario scenario;
  if (outcome.ok()) scenario = *std::move(outcome.scenario);
  return scenario;
}

std::string hash_of(const Scenario& scenario, int threads = 1, double speed = 0) {
  QuietRun how;
  how.threads = threads;
  how.speed = speed;
  const auto summary = run_quietly(scenario, KindRegistry(), how);
  EXPECT_TRUE(summary.ok()) << summary.error().text();
  return summary.ok() ? summary.value().content_hash : "";
}

TEST(Kinds, EveryKindHasDefaultsThatAreAllowedAndCanBeMade) {
  const scenario::KindTable table = kind_table();
  EXPECT_GE(table.of("estimator").size(), 9u);
  EXPECT_GE(table.of("strategy").size(), 6u);
  for (const auto& kind : table.of("estimator"))
    for (const auto& strategy : table.of("strategy"))
      EXPECT_TRUE(build(read("duration_s: 1\nmissions: [{kind: perimeter, estimator: " +
                             kind.name + ", strategy: " + strategy.name + "}]"),
                        KindRegistry())
                      .ok())
          << kind.name << " " << strategy.name;
}

TEST(Build, PutsTheStationFirstAndAircraftInOrder) {
  const auto built =
      build(read("aircraft: [{name: a, count: 2}, {name: b, count: 1}]"), KindRegistry());
  ASSERT_TRUE(built.ok());
  const auto& entities = built.value().world.entities;
  ASSERT_EQ(entities.size(), 4u);
  EXPECT_EQ(entities[0].name, "station");
  EXPECT_EQ(entities[2].name, "a-2");
  EXPECT_EQ(entities[3].name, "b-1");
  // Two stand on opposite sides, facing the centre, at their height above ground.
  EXPECT_NEAR(entities[1].vehicle->truth()->p_N.x(), 900, 1e-9);
  EXPECT_NEAR(entities[2].vehicle->truth()->p_N.x(), -900, 1e-9);
  EXPECT_NEAR(entities[1].vehicle->truth()->p_N.z(), -120, 1e-9);
  EXPECT_NEAR(std::abs(geo::yaw(entities[1].vehicle->truth()->q_NB)), geo::kPi, 1e-9);
}

TEST(Build, RefusesAnAircraftInsideTerrainOrInAZone) {
  const auto inside =
      build(read("environment: {terrain: {kind: flat, elevation_m: 500}}\n"
                 "aircraft: [{count: 1, start: {altitude_msl_m: 400}}]"),
            KindRegistry());
  ASSERT_FALSE(inside.ok());
  EXPECT_NE(inside.error().text().find("scout-1"), std::string::npos)
      << inside.error().text();
  EXPECT_NE(inside.error().text().find("500"), std::string::npos)
      << inside.error().text();
  const auto zone = build(read("environment: {zones_m: [[[800, -100], [1000, -100], "
                               "[1000, 100], [800, 100]]]}"),
                          KindRegistry());
  ASSERT_FALSE(zone.ok());
  EXPECT_NE(zone.error().text().find("no-fly zone"), std::string::npos);
}

TEST(Build, ReportsAllErrorsInDataAtOnce) {
  const std::string wind = testing::TempDir() + "wind_without_numbers.csv";
  std::ofstream(wind) << "t_s,speed_mps,from_deg\n0,fast,200\n";
  const auto built = build(
      read("environment: {terrain: {kind: flat, elevation_m: 500}, wind: {kind: series, "
           "file: '" +
           wind +
           "'}}\naircraft: [{name: a, start: {altitude_msl_m: 400}}, "
           "{name: b, start: {altitude_msl_m: 300}}]"),
      KindRegistry());
  ASSERT_FALSE(built.ok());
  for (const char* text : {"3 problems:", "wind_without_numbers.csv:2",
                           "a-1: starts inside terrain", "b-1: starts inside terrain"})
    EXPECT_NE(built.error().text().find(text), std::string::npos) << built.error().text();
}

TEST(Build, NumbersGroupsOfOneNameOn) {
  const auto built = build(
      read("aircraft: [{name: a, count: 2}, {name: b, count: 1}, {name: a, count: 1}]"),
      KindRegistry());
  ASSERT_TRUE(built.ok());
  std::vector<std::string> names;
  for (const auto& entity : built.value().world.entities) names.push_back(entity.name);
  EXPECT_EQ(names, (std::vector<std::string>{"station", "a-1", "a-2", "b-1", "a-3"}));
}

TEST(Build, NamesAPhenomenonThatDoesNotExist) {
  const char* const kWrong[] = {
      "missions: [{kind: perimeter, phenomenon: 2}]",
      "aircraft: [{sensors: [{kind: fire, phenomenon: 2}]}]",
      "aircraft: [{sensors: [flight, {kind: edge-finder, phenomenon: 2}]}]"};
  for (const std::string wrong : kWrong) {
    const auto built = build(read("environment: {phenomena: [front, thesis]}\n" + wrong),
                             KindRegistry());
    ASSERT_FALSE(built.ok()) << wrong;
    EXPECT_NE(
        built.error().text().find("environment.phenomena has no number 2: there are 2."),
        std::string::npos)
        << built.error().text();
  }
}

// What is wrong with a scenario, one line each.
std::string problems_of(const std::string& text) {
  std::string lines;
  for (const auto& problem :
       scenario::read_scenario_text(text, "test", ".", kind_table()).problems)
    lines += problem.text() + "\n";
  return lines;
}

TEST(Kinds, ReportIncompatibilitiesWithTheirPlace) {
  EXPECT_EQ(
      problems_of("environment:\n"
                  "  phenomena:\n"
                  "  - kind: thesis\n"
                  "    start_radius_m: 400\n"
                  "    displacement_m: 500\n"
                  "    rate_error_mps: 0.5\n"
                  "    wind_mps: [2, 2]\n"
                  "aircraft:\n"
                  "  - plant: {kind: kinematic, airspeed_mps: 1}\n"
                  "  - plant: {kind: kinematic, climb_rate_mps: 25}\n"),
      "test:5:5 environment.phenomena[0].displacement_m: 500 must be below "
      "start_radius_m, "
      "400.\n"
      "test:7:5 environment.phenomena[0].wind_mps: a drift of 2.82843 m/s must be below "
      "the "
      "minimum spread, 2.5 m/s (rate_mps - rate_error_mps): a stronger one drives the "
      "boundary over its own origin.\n"
      "test:9:30 aircraft[0].plant.climb_rate_mps: 3 must be below the slowest "
      "airspeed, 0.75 (airspeed_mps times 1 - airspeed_range).\n"
      "test:10:30 aircraft[1].plant.climb_rate_mps: 25 must be below the slowest "
      "airspeed, 15 (airspeed_mps times 1 - airspeed_range).\n");
  EXPECT_EQ(problems_of("environment: {phenomena: [{kind: thesis, rate_mps: 1, "
                        "rate_error_mps: 2}]}"),
            "test:1:55 environment.phenomena[0].rate_error_mps: 2 must be at most "
            "rate_mps, 1.\n");
  EXPECT_EQ(problems_of("environment: {phenomena: [{kind: front, rate_mps: 50, "
                        "marker_spacing_m: 100, ignitions: [{}, {radius_m: 5}]}]}"),
            "test:1:51 environment.phenomena[0].rate_mps: 50 must be from 0 to 20. The "
            "default is "
            "0.05.\n"
            "test:1:95 environment.phenomena[0].ignitions[1].radius_m: 5 must be at "
            "least a tenth "
            "of marker_spacing_m, 10.\n");
}

TEST(Kinds, HaveRoundDefaultsInTheUnitsOfTheirKeys) {
  const std::string keys = scenario::markdown_keys(kind_table());
  const std::regex long_number("[0-9]\\.[0-9]{6,}");
  std::smatch match;
  EXPECT_FALSE(std::regex_search(keys, match, long_number)) << match.str();
}

// All keys of a choice stand for something: other kinds' keys are unknown.
TEST(Kinds, HaveOnlyTheKeysThatTheyUse) {
  const auto problem = [](const std::string& estimator) {
    return problems_of("missions: [{kind: perimeter, estimator: {" + estimator + "}}]");
  };
  for (const char* good :
       {"kind: qkf, control_points: 90", "kind: joint, control_points: 90",
        "kind: particle, particles: 100, false_rate: 0.1", "kind: map, sigma_v_m: 3",
        "kind: mle, sigma_v_m: 3", "kind: point-reset, min_sd_m: 2"})
    EXPECT_EQ(problem(good), "") << good;
  for (const char* bad :
       {"kind: qkf, particles: 100", "kind: qkf, min_sd_m: 2", "kind: qkf, sigma_v_m: 3",
        "kind: particle, min_sd_m: 2", "kind: point-reset, use_crossings: false",
        "kind: point-reset, gate_sigmas: 2", "kind: ensemble, control_points: 90"})
    EXPECT_NE(problem(bad).find("unknown key. The kind \""), std::string::npos)
        << problem(bad);
  EXPECT_NE(problems_of("missions: [{kind: perimeter, control_points: 60}]")
                .find("unknown key"),
            std::string::npos);
}

TEST(Build, MovesTheFireAsOftenAsSensorsLook) {
  const auto period = [](const std::string& more) {
    const auto built = build(read(more), KindRegistry());
    EXPECT_TRUE(built.ok());
    return built.value().options.environment_period.seconds();
  };
  EXPECT_EQ(period("name: x"), 1);
  EXPECT_EQ(period("aircraft: [{sensors: [gnss, {kind: fire, rate_hz: 0.2}]}]"), 1);
  EXPECT_EQ(period("aircraft: [{sensors: [{kind: fire, rate_hz: 2}]}]"), 0.5);
  EXPECT_EQ(period("aircraft: [{sensors: [{kind: edge-finder, rate_hz: 10}]}]"), 0.1);
  EXPECT_EQ(period("aircraft: [{sensors: [{kind: fire, rate_hz: 2}, {kind: fire, "
                   "rate_hz: 2.5}]}]"),
            0.1);
  // Not every whole number of steps: a look may fall into any step.
  EXPECT_EQ(period("aircraft: [{sensors: [{kind: fire, rate_hz: 3}]}]"), 0.1);
  EXPECT_EQ(period("record: {metrics_period_s: 2.5}"), 0.5);
  EXPECT_EQ(period("environment: {period_s: 4}"), 4);
}

TEST(Build, WarnsOfLooksAtAFireOfThePastAndOfRatesAboveTheSteps) {
  const auto warnings = [](const std::string& text) {
    const auto built = build(read(text), KindRegistry());
    EXPECT_TRUE(built.ok());
    std::string lines;
    for (const std::string& line : built.value().warnings) lines += line + "\n";
    return lines;
  };
  EXPECT_EQ(warnings("name: x"), "");
  EXPECT_EQ(warnings("environment: {period_s: 0.5}\n"
                     "aircraft: [{sensors: [gnss, {kind: fire, rate_hz: 4}]}]"),
            "environment.period_s: the fire moves every 0.5 s, and "
            "aircraft[0].sensors[1].rate_hz looks at it every 0.1 s: it sees a fire that "
            "stands still in between. Leave the key out, or write 0.1.\n");
  EXPECT_EQ(warnings("aircraft: [{sensors: [{kind: fire, rate_hz: 1000}]}]"),
            "aircraft[0].sensors[0].rate_hz: 1000 samples a second are more than the 10 "
            "steps a second of step_s 0.1: the sensor has one in each step.\n");
}

TEST(Run, TakesNoAircraftAndHardlyAnyTime) {
  EXPECT_NE(hash_of(read("duration_s: 60\naircraft: []")), "");
  EXPECT_NE(hash_of(read("duration_s: 0.001")), "");
}

TEST(Kinds, AnEnsembleThatIsTooLargeIsRefusedBeforeItTakesMemory) {
  const auto problems = [](const std::string& ensemble) {
    return scenario::read_scenario_text(
               "missions: [{kind: perimeter, estimator: {kind: ensemble, cell_m: "
               "0.5, " +
                   ensemble + "}}]",
               "test", ".", kind_table())
        .report();
  };
  EXPECT_EQ(problems("members: 40, max_nodes: 1000000"), "");
  EXPECT_EQ(
      problems("members: 50, max_nodes: 1000000"),
      "test:1:84 missions[0].estimator.max_nodes: 1000000 nodes of 50 members are too "
      "much memory; at most 800000 nodes are allowed for so many members.\n1 "
      "problem; nothing was run.\n");
  EXPECT_NE(problems("max_nodes: 10000000"), "");
}

TEST(Kinds, TooManyParticlesAreRefusedBeforeTheyTakeMemory) {
  const auto problems = [](const std::string& particles) {
    return scenario::read_scenario_text(
               "missions: [{kind: perimeter, estimator: {kind: particle, " + particles +
                   "}}]",
               "test", ".", kind_table())
        .report();
  };
  EXPECT_EQ(problems("particles: 1000, control_points: 5000"), "");
  EXPECT_NE(problems("particles: 1001, control_points: 5000").find("at most 1000 are "),
            std::string::npos);
}

TEST(Build, WarnsWhenThereIsNoAircraft) {
  const auto warnings = [](const std::string& text) {
    const auto built = build(read(text), KindRegistry());
    EXPECT_TRUE(built.ok()) << text;
    return built.ok() ? built.value().warnings : std::vector<std::string>();
  };
  EXPECT_TRUE(warnings("duration_s: 1").empty());
  EXPECT_TRUE(warnings("aircraft: [{count: 0}, {count: 1}]").empty());
  for (const char* nobody : {"aircraft: []", "aircraft: [{count: 0}]"}) {
    const auto found = warnings(nobody);
    ASSERT_EQ(found.size(), 1u) << nobody;
    EXPECT_TRUE(found[0].starts_with("no aircraft: ")) << found[0];
  }
}

TEST(Run, SameHashForAnyThreadsAndSpeed) {
  const Scenario scenario = read(
      "duration_s: 40\n"
      "environment: {terrain: canyon, wind: {kind: uniform, speed_mps: 5, from_deg: "
      "200}}\n"
      "aircraft: [{count: 40}]\n"
      "radio: {kind: ideal, delay_s: 0.2, jitter_s: 0.5, loss: 0.1}");
  const std::string expected = hash_of(scenario);
  EXPECT_EQ(hash_of(scenario, 2), expected);
  EXPECT_EQ(hash_of(scenario, 4), expected);
  EXPECT_EQ(hash_of(scenario, 2, 100), expected) << "at 100 times real time";
  Scenario other = scenario;
  other.seed = 2;
  EXPECT_NE(hash_of(other), expected);
}

TEST(Run, WhatIsStoredChangesNoFigure) {
  Scenario scenario = read("duration_s: 60\nradio: {kind: ideal, loss: 0.2}");
  const auto with = run_quietly(scenario, KindRegistry(), {});
  scenario.record.messages = false;
  const auto without = run_quietly(scenario, KindRegistry(), {});
  ASSERT_TRUE(with.ok() && without.ok());
  EXPECT_GT(without.value().number("messages_sent").value_or(0), 50);
  for (const char* figure : {"messages_sent", "messages_lost"})
    EXPECT_EQ(without.value().number(figure), with.value().number(figure)) << figure;
  EXPECT_EQ(without.value().content_hash, with.value().content_hash);
}

TEST(Build, EachSensorOfAnAircraftHasItsOwnErrors) {
  const auto readings = [&](const std::string& sensors) {
    auto built = build(read("aircraft: [{sensors: [" + sensors + "]}]"), KindRegistry());
    EXPECT_TRUE(built.ok());
    const simulation::World& world = built.value().world;
    const simulation::VehicleParts& vehicle = parts_of(world.entities[1]);
    const Phenomenon* const phenomena[] = {world.phenomena.front().get()};
    std::vector<std::vector<bool>> all(vehicle.payload.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::vector<SensorSample> samples;
      for (int k = 0; k < 200; ++k)
        vehicle.payload[i]->sample({Time::from_seconds(k), vehicle.state, vehicle.air,
                                    *world.terrain, phenomena},
                                   samples);
      for (const SensorSample& sample : samples)
        if (const auto* fire = std::get_if<FireSample>(&sample))
          all[i].push_back(fire->inside);
    }
    return all;
  };
  const std::string uncertain = "{kind: fire, false_in: 0.3, false_out: 0.3}";
  const auto alone = readings(uncertain);
  const auto both = readings(uncertain + ", gnss, " + uncertain);
  ASSERT_EQ(alone[0].size(), 200u);
  EXPECT_EQ(both[0], alone[0]) << "another sensor does not shift the first one's errors";
  ASSERT_EQ(both.size(), 2u) << "the receiver is a flight sensor";
  EXPECT_NE(both[1], both[0]);
}

TEST(Run, TheWrittenScenarioGivesTheSameRun) {
  const Scenario scenario = read("duration_s: 30\nenvironment: {phenomena: [thesis]}");
  const std::string text = scenario::write_scenario(scenario, kind_table());
  EXPECT_EQ(hash_of(read(text)), hash_of(scenario));
}

TEST(Placement, StandsWhereTheScenarioSays) {
  scenario::Start start;
  start.placement = scenario::Placement::kRing;
  start.distance = 100;
  Place place = place_at_start(start, 1, 4);
  EXPECT_NEAR(place.position.y(), 100, 1e-9);
  EXPECT_NEAR(std::abs(place.heading), geo::kPi,
              1e-9);  // clockwise: southwards in the east
  start.placement = scenario::Placement::kLine;
  start.heading = geo::kPi / 2;
  place = place_at_start(start, 0, 3);
  EXPECT_NEAR(place.position.x(), 100, 1e-9);  // left of an eastward heading is north
  EXPECT_NEAR(place.heading, geo::kPi / 2, 1e-9);
}

TEST(Presence, CutsOutWhatAnAircraftMisses) {
  const auto s = [](double seconds) { return Time::from_seconds(seconds); };
  AircraftGroup group;
  group.count = 2;
  group.join = s(10);
  group.leave = s(100);
  group.comeback = s(200);
  scenario::Failure failure;
  failure.at = s(50);
  failure.until = s(60);
  failure.aircraft = 1;
  group.failures = {failure};
  const auto first = presence(group, 0, s(300));
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].from, s(10));
  EXPECT_EQ(first[0].until, s(100));
  EXPECT_EQ(first[1].from, s(200));
  EXPECT_GT(first[1].until, s(300));
  const auto second = presence(group, 1, s(300));
  ASSERT_EQ(second.size(), 3u);
  EXPECT_EQ(second[0].until, s(50));
  EXPECT_EQ(second[1].from, s(60));
}

}  // namespace
}  // namespace skein::assemble::assemble_test
