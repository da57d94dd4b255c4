// SPDX-License-Identifier: Apache-2.0
// Starts from the ground whose conditions are drawn at random, judged by the truth.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/test/whole_flight.h"
#include "skein/assemble/world/run.h"
#include "skein/campaign/ground_starts/ground_starts_study.h"

namespace skein::assemble::ground_start_test {
namespace {

// Neither these seeds nor those of the study's figures were used to choose any number.
constexpr int kFirstSeed = 70001;
constexpr int kStarts = 24;

std::map<std::string, double> start(const campaign::BatchItem& item) {
  campaign::StartWatch watch = campaign::start_watch_of(item);
  QuietRun how;
  how.listener = &watch;
  const auto summary = run_quietly(item.scenario, KindRegistry(), how);
  if (!summary) throw std::runtime_error(summary.error().text());
  std::map<std::string, double> figures;
  watch.add_figures(figures);
  return figures;
}

TEST(GroundStart, IsNotLostInWindsAndGustsDrawnAtRandom) {
  campaign::GroundStartsStudy study;
  study.base = std::string(SKEIN_SOURCE_DIR) + "/scenarios/ground-starts.yaml";
  study.first_seed = kFirstSeed;
  study.seeds = kStarts;
  const auto plan = plan_ground_starts_study(study, kind_table());
  ASSERT_TRUE(plan) << plan.error().text();
  for (const campaign::BatchItem& item : plan.value().items) {
    SCOPED_TRACE(item.name);
    const std::map<std::string, double> figures = start(item);
    for (const char* cause : {"accident", "tilt", "belief", "failsafe", "climb"})
      EXPECT_EQ(figures.at(std::string("lost_") + cause), 0) << cause;
  }
}

// A wing that stands in severe turbulence for five seconds, with a heading across the
// wind.
FlightLog stand(const char* aircraft, bool held) {
  return fly(fmt::format(R"(
seed: 5
duration_s: 4.9
environment: {{terrain: flat, phenomena: [], wind: {{kind: uniform, speed_mps: 8, from_deg: 90}}, turbulence: {{kind: dryden, intensity: severe}}}}
missions: []
aircraft:
  - plant: {{kind: fixed-wing, aircraft: {}}}
    autopilot: skein
    sensors: [flight]
    agent: {{kind: route, points_m: [[400, 0], [400, 400], [0, 0]], laps: 1}}
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 20, on_ground: true, held: {}}}
)",
                         aircraft, held));
}

TEST(GroundStart, ACrewHoldsAWingInGustsUntilItsMotorHasPower) {
  for (const char* aircraft : {"aerosonde-stall", "bixler"}) {
    SCOPED_TRACE(aircraft);
    const FlightLog held = stand(aircraft, true), alone = stand(aircraft, false);
    for (const FlightRow& row : held.rows.at(1)) {
      EXPECT_TRUE(row.truth.held);
      EXPECT_TRUE(row.truth.v_N.isZero());
    }
    double moved = 0;
    for (const FlightRow& row : alone.rows.at(1))
      moved = std::max(moved, row.truth.v_N.norm());
    EXPECT_GT(moved, 0.1) << "these gusts do move it";
  }
}

TEST(GroundStart, OneThatIsThrownByHandIsHeldIntoTheWind) {
  const FlightRow thrown = stand("bixler", true).rows.at(1).front();
  EXPECT_NEAR(thrown.attitude().yaw, geo::radians(90), 1e-6);
  EXPECT_NEAR(thrown.attitude().pitch, geo::radians(15), 1e-6);
  EXPECT_NEAR(thrown.altitude(), 1.8, 1e-9);
  const FlightRow rolls = stand("aerosonde-stall", true).rows.at(1).front();
  EXPECT_NEAR(rolls.attitude().yaw, geo::radians(20), 1e-6);
  EXPECT_EQ(rolls.altitude(), 0);
}

}  // namespace
}  // namespace skein::assemble::ground_start_test
