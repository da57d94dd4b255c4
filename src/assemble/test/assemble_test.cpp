#include <gtest/gtest.h>

#include "assemble/build.h"
#include "assemble/kinds_of.h"
#include "assemble/placement.h"
#include "assemble/presence.h"
#include "assemble/run.h"
#include "scenario/scenario_file.h"

namespace skein::assemble {
namespace {

using scenario::AircraftGroup;
using scenario::Scenario;

// A scenario from text; the test ends when it has problems.
Scenario read(const std::string& text) {
  auto outcome = scenario::read_scenario_text(text, "test", ".", kind_table());
  EXPECT_TRUE(outcome.ok()) << outcome.report();
  return outcome.ok() ? *outcome.scenario : Scenario{};
}

std::string hash_of(const Scenario& scenario, int threads = 1, double speed = 0) {
  QuietRun how;
  how.threads = threads;
  how.speed = speed;
  const auto summary = run_quietly(scenario, how);
  EXPECT_TRUE(summary.ok()) << summary.error().text();
  return summary.ok() ? summary.value().content_hash : "";
}

TEST(Kinds, EveryKindHasDefaultsThatAreAllowedAndCanBeMade) {
  const scenario::KindTable table = kind_table();
  EXPECT_GE(table.of("estimator").size(), 9u);
  EXPECT_GE(table.of("strategy").size(), 6u);
  for (const auto& kind : table.of("estimator"))
    for (const auto& strategy : table.of("strategy"))
      EXPECT_TRUE(build(read("duration_s: 0\nmonitoring: {estimator: " + kind.name +
                             ", strategy: " + strategy.name + "}"))
                      .ok())
          << kind.name << " " << strategy.name;
}

TEST(Build, PutsTheStationFirstAndAircraftInOrder) {
  const auto built = build(read("aircraft: [{name: a, count: 2}, {name: b, count: 1}]"));
  ASSERT_TRUE(built.ok());
  const auto& entities = built.value().world.entities;
  ASSERT_EQ(entities.size(), 4u);
  EXPECT_EQ(entities[0].name, "station");
  EXPECT_EQ(entities[2].name, "a-2");
  EXPECT_EQ(entities[3].name, "b-1");
  // Two stand on opposite sides, facing the centre, at their height above ground.
  EXPECT_NEAR(entities[1].vehicle->state.p_N.x(), 900, 1e-9);
  EXPECT_NEAR(entities[2].vehicle->state.p_N.x(), -900, 1e-9);
  EXPECT_NEAR(entities[1].vehicle->state.p_N.z(), -120, 1e-9);
  EXPECT_NEAR(std::abs(entities[1].vehicle->state.heading), geo::kPi, 1e-9);
}

TEST(Build, RefusesAnAircraftInsideTerrainOrInAZone) {
  const auto inside =
      build(read("environment: {terrain: {kind: flat, elevation_m: 500}}\n"
                 "aircraft: [{count: 1, start: {altitude_msl_m: 400}}]"));
  ASSERT_FALSE(inside.ok());
  EXPECT_NE(inside.error().text().find("scout-1"), std::string::npos)
      << inside.error().text();
  EXPECT_NE(inside.error().text().find("500"), std::string::npos)
      << inside.error().text();
  const auto zone = build(read(
      "environment: {zones_m: [[[800, -100], [1000, -100], [1000, 100], [800, 100]]]}"));
  ASSERT_FALSE(zone.ok());
  EXPECT_NE(zone.error().text().find("no-flight zone"), std::string::npos);
}

TEST(Build, RefusesPeriodsThatAreNoWholeStep) {
  const auto built = build(read("step_s: 0.3"));
  ASSERT_FALSE(built.ok());
  EXPECT_NE(built.error().text().find("whole number of steps"), std::string::npos);
}

TEST(Run, TakesNoAircraftAndNoTime) {
  EXPECT_NE(hash_of(read("duration_s: 60\naircraft: []")), "");
  EXPECT_NE(hash_of(read("duration_s: 0")), "");
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
  const auto with = run_quietly(scenario, {});
  scenario.record.messages = false;
  const auto without = run_quietly(scenario, {});
  ASSERT_TRUE(with.ok() && without.ok());
  EXPECT_GT(without.value().number("messages_sent").value_or(0), 50);
  for (const char* figure : {"messages_sent", "messages_lost"})
    EXPECT_EQ(without.value().number(figure), with.value().number(figure)) << figure;
  EXPECT_EQ(without.value().content_hash, with.value().content_hash);
}

TEST(Build, EachSensorOfAnAircraftErrsInItsOwnWay) {
  const auto readings = [&](const std::string& sensors) {
    auto built = build(read("aircraft: [{sensors: [" + sensors + "]}]"));
    EXPECT_TRUE(built.ok());
    const simulation::World& world = built.value().world;
    const simulation::Vehicle& vehicle = *world.entities[1].vehicle;
    std::vector<std::vector<bool>> all(vehicle.sensors.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::vector<SensorSample> samples;
      for (int k = 0; k < 200; ++k)
        vehicle.sensors[i]->sample(
            {Time::from_seconds(k), vehicle.state, *world.terrain, *world.fire}, samples);
      for (const SensorSample& sample : samples)
        if (const auto* fire = std::get_if<FireSample>(&sample))
          all[i].push_back(fire->inside);
    }
    return all;
  };
  const std::string doubtful = "{kind: fire, false_in: 0.3, false_out: 0.3}";
  const auto alone = readings(doubtful);
  const auto both = readings(doubtful + ", gnss, " + doubtful);
  ASSERT_EQ(alone[0].size(), 200u);
  EXPECT_EQ(both[0], alone[0]) << "another sensor does not shift the first one's errors";
  EXPECT_NE(both[2], both[0]);
}

TEST(Run, TheWrittenScenarioGivesTheSameRun) {
  const Scenario scenario = read("duration_s: 30\nenvironment: {fire: thesis}");
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
}  // namespace skein::assemble
