// SPDX-License-Identifier: Apache-2.0
// From ground to ground with the agents that scenarios name, as `skein run` flies them.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <utility>

#include "skein/assemble/test/whole_flight.h"

namespace skein::assemble::ground_flight_test {
namespace {

std::string scenario_of(const char* plant, const char* agent, const char* more = "") {
  return fmt::format(R"(
seed: 3
duration_s: 420
environment: {{terrain: flat, phenomena: [], wind: {{kind: uniform, speed_mps: 3, from_deg: 0}}, turbulence: {{kind: dryden, intensity: light}}{}}}
missions: []
aircraft:
  - name: a
    plant: {}
    autopilot: skein
    sensors: [{{kind: flight, receiver: differential}}]
    agent: {}
    altitude_agl_m: 60
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 0, on_ground: true}}
)",
                     more, plant, agent);
}

constexpr const char* kRoute =
    "{kind: route, points_m: [[300, 0], [300, 250], [0, 250], [0, 250]], laps: 2, "
    "lands: true}";

TEST(WholeRoute, LeadsFromGroundToGround) {
  const std::pair<const char*, double> cases[] = {
      // At rest from where it took off at most [m]: the receiver's error, and what a wing
      // without brakes floats and slides in gusts.
      {"multirotor", 3},
      {"{kind: fixed-wing, aircraft: bixler}", 50},
      {"{kind: fixed-wing, aircraft: aerosonde-stall}", 15}};
  for (const auto& [plant, off] : cases) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly(scenario_of(plant, kRoute));
    for (const EventKind kind :
         {EventKind::kTookOff, EventKind::kRouteDone, EventKind::kLanded})
      EXPECT_NE(log.find(kind), nullptr) << row_of(kind).name << "\n" << log.story();
    EXPECT_EQ(log.find(EventKind::kAccident), nullptr) << log.story();
    EXPECT_EQ(log.find(EventKind::kRefused), nullptr) << log.story();
    const FlightRow& last = log.rows.at(1).back();
    EXPECT_TRUE(last.truth.on_ground);
    EXPECT_TRUE(last.status.on_ground);
    EXPECT_LT(geo::horizontal(last.truth.p_N).norm(), off);
  }
}

TEST(WholeRoute, AWingThatFliesIntoAHillsideHasAnAccident) {
  for (const char* aircraft : {"bixler", "aerosonde-stall"}) {
    SCOPED_TRACE(aircraft);
    // At 60 m the hill of 300 m rises by 0.27: faster than gears bear at these speeds.
    const AutopilotCommand command{HoldCourse{geo::kPi}, 60, {}};
    const FlightLog log = fly(fmt::format(R"(
duration_s: 120
environment:
  terrain: {{kind: hill, height_m: 300, width_m: 400, centre_m: [0, 0]}}
  wind: {{kind: uniform, speed_mps: 0, from_deg: 0}}
  phenomena: []
missions: []
aircraft:
  - plant: {{kind: fixed-wing, aircraft: {}}}
    autopilot: skein
    sensors: [flight]
    altitude_agl_m: 60
    start: {{placement: list, positions_m: [[1500, 0]], heading_deg: 180}}
)",
                                          aircraft),
                              {{{command}}});
    ASSERT_NE(log.find(EventKind::kAccident), nullptr) << log.story();
    const FlightRow& last = log.rows.at(1).back();
    EXPECT_LT(last.altitude(), 90) << "on the flank, not on top";
  }
}

TEST(WholeRoute, AScoutAndAWingmanTakeOffToo) {
  for (const char* agent : {"scout", "wingman"}) {
    SCOPED_TRACE(agent);
    const FlightLog log = fly(scenario_of("{kind: fixed-wing, aircraft: bixler}", agent));
    EXPECT_NE(log.find(EventKind::kTookOff), nullptr) << log.story();
    EXPECT_EQ(log.find(EventKind::kLanded), nullptr) << log.story();
    EXPECT_GT(log.rows.at(1).back().altitude(), 45);
  }
}

TEST(WholeRoute, ThroughANoFlightZoneIsRefusedWithItsPlace) {
  try {
    fly(scenario_of("multirotor", kRoute,
                    ", zones_m: [[[100, -50], [200, -50], [200, 50], [100, 50]]]"));
    FAIL() << "was flown";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no-fly zone at 100 m north, 0 m east"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace skein::assemble::ground_flight_test
