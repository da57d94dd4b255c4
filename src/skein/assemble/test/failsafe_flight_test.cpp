// SPDX-License-Identifier: Apache-2.0
// What goes wrong in flight, through the whole stack: parts fail by the scenario, the
// sensors show it, and the autopilot reacts.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "skein/assemble/test/whole_flight.h"

namespace skein::assemble::failsafe_flight_test {
namespace {

// A multirotor that has lost its satellites must be down before it has lost its velocity:
// from 60 m it takes half a minute.
constexpr double kAltitude = 60;
constexpr char kBixler[] = "{kind: fixed-wing, aircraft: bixler}";
constexpr char kQuad[] = "multirotor";

// The pilot takes over before the fault and hands back after it.
constexpr double kFault = 20, kTakesOver = 19, kHandsBack = 32;
// Events are reported at the end of a step of the run.
constexpr double kStep = 0.1;

struct Trouble {
  std::string name;
  std::string failures, options;  // of the scenario
  double delay;                   // from the fault to the reaction, at most [s]
  FailsafeReaction wing, quad;
};

// Delays: the failsafe's own, and the period and latency of the sensor that shows it
// (heartbeats: 1 s; fixes: 0.2 s; motors: 0.2 s until it is known, 0.1 s a sample, 0.3 s
// of watching).
const Trouble kTroubles[] = {
    {"link", "{kind: link, at_s: 20}", "", 5, FailsafeReaction::kReturn,
     FailsafeReaction::kReturn},
    {"gnss", "{kind: sensor, part: gnss-receiver, at_s: 20}", "", 2.1,
     FailsafeReaction::kHold, FailsafeReaction::kDescend},
    {"motor", "{kind: motor, at_s: 20}", "", 0.8, FailsafeReaction::kDescend,
     FailsafeReaction::kDescend},
};

FlightLog fly_into(const Trouble& trouble, const char* plant, const std::string& mode,
                   double duration) {
  const bool pilot = mode == "stabilized" || mode == "manual";
  const std::string takeover = fmt::format(
      ", {{kind: safety-pilot, takeovers: [{{from_s: {}, until_s: {}, mode: {}, "
      "throttle: {}}}]}}",
      kTakesOver, kHandsBack, pilot ? mode : "stabilized", plant == kQuad ? 0.5 : 0.6);
  const std::string text =
      fmt::format(R"(
seed: 1
duration_s: {}
environment:
  terrain: flat
  wind: {{kind: uniform, speed_mps: 4, from_deg: 250}}
  phenomena: []
missions: [formation]
aircraft:
  - plant: {}
    autopilot: {{kind: skein, {}}}
    sensors: [{{kind: flight, receiver: differential}}{}]
    agent: wingman
    altitude_agl_m: {}
    agent_period_s: 0.1
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 0}}
    failures: [{}]
)",
                  duration, plant, trouble.options, pilot ? takeover : "", kAltitude,
                  trouble.failures);
  AutopilotCommand command{HoldCourse{0}, kAltitude, {}};
  if (mode == "auto") {
    FlyWaypoints route;
    route.points = {{{500, 0}, kAltitude}, {{500, 100}, kAltitude}};
    command.guidance = route;
  }
  return fly(text, {{{command}}});
}

// When the aircraft first does this; negative: never.
double since(const FlightLog& log, FailsafeReaction reaction) {
  for (const FlightRow& row : log.rows.at(1))
    if (row.status.reaction == reaction) return row.time.seconds();
  return -1;
}

bool reported(const FlightLog& log, FailsafeTrigger trigger) {
  for (const FlightRow& row : log.rows.at(1))
    if (row.status.trigger == trigger) return true;
  return false;
}

// How a reaction ends: where it should, and whole.
void expect_end(const FlightLog& log, FailsafeReaction reaction, bool quad) {
  EXPECT_EQ(log.find(EventKind::kAccident), nullptr) << log.story();
  const FlightRow& end = log.rows.at(1).back();
  if (reaction == FailsafeReaction::kReturn) {
    EXPECT_FALSE(end.truth.on_ground);
    // A wing circles home; a differential receiver is 0.6 m off.
    EXPECT_LT(geo::horizontal(end.truth.p_N).norm(), quad ? 3 : 120);
  } else {
    EXPECT_TRUE(end.truth.on_ground) << log.story();
    EXPECT_LT(end.truth.v_N.norm(), 0.1);
    const std::size_t motor = quad ? 1 : channel::kThrottle;
    EXPECT_LT(end.truth.actuators[motor], 1) << "the motors stand";
  }
}

TEST(Failsafe, ReactsInTimeInEveryModeAndEndsWell) {
  for (const char* plant : {kBixler, kQuad})
    for (const Trouble& trouble : kTroubles)
      for (const char* mode : {"guided", "auto"}) {
        SCOPED_TRACE(fmt::format("{} {} {}", plant, trouble.name, mode));
        const bool quad = plant == kQuad;
        const FailsafeReaction reaction = quad ? trouble.quad : trouble.wing;
        const FlightLog log = fly_into(trouble, plant, mode, 250);
        const double at = since(log, reaction);
        EXPECT_GT(at, kFault) << log.story();
        EXPECT_LE(at, kFault + trouble.delay + kStep) << log.story();
        expect_end(log, reaction, quad);
      }
}

TEST(Failsafe, WhatWasNeverReceivedIsMissedToo) {
  const Trouble troubles[] = {{"link", "{kind: link, at_s: 0}", "", 5,
                               FailsafeReaction::kReturn, FailsafeReaction::kReturn},
                              {"gnss", "{kind: sensor, part: gnss-receiver, at_s: 0}", "",
                               2.1, FailsafeReaction::kHold, FailsafeReaction::kDescend}};
  for (const char* plant : {kBixler, kQuad})
    for (const Trouble& trouble : troubles) {
      SCOPED_TRACE(fmt::format("{} {}", plant, trouble.name));
      const FlightLog log = fly_into(trouble, plant, "guided", 10);
      const double at = since(log, plant == kQuad ? trouble.quad : trouble.wing);
      EXPECT_GE(at, 0) << log.story();
      EXPECT_LE(at, trouble.delay + kStep) << log.story();
    }
}

TEST(Failsafe, WaitsForThePilotAndActsWhenHeHandsBack) {
  for (const char* plant : {kBixler, kQuad})
    for (const Trouble& trouble : kTroubles)
      for (const char* mode : {"stabilized", "manual"}) {
        SCOPED_TRACE(fmt::format("{} {} {}", plant, trouble.name, mode));
        const bool quad = plant == kQuad;
        // Three rotors do not carry a quadrotor by turn rates: see the next test.
        if (quad && trouble.name == "motor" && mode == std::string("manual")) continue;
        const FailsafeReaction reaction = quad ? trouble.quad : trouble.wing;
        const FlightLog log = fly_into(trouble, plant, mode, 250);
        const Event* taken = log.find(EventKind::kMode, mode);
        ASSERT_NE(taken, nullptr) << log.story();
        EXPECT_NEAR(taken->time.seconds(), kTakesOver + kStep, 1e-9);
        const double at = since(log, reaction);
        EXPECT_GE(at, kHandsBack) << log.story();
        EXPECT_LE(at, kHandsBack + 2 * kStep) << log.story();
        for (const FlightRow& row : log.rows.at(1)) {
          const double t = row.time.seconds();
          if (t > kTakesOver + kStep && t < kHandsBack) {
            EXPECT_EQ(name_of(row.status.mode), mode) << t;
          }
        }
        expect_end(log, reaction, quad);
      }
}

TEST(Failsafe, AQuadrotorWithoutPowerFallsAndTheRunGoesOn) {
  const Trouble dead{"battery", "{kind: battery, at_s: 20}", "", 0.8, {}, {}};
  const FlightLog log = fly_into(dead, kQuad, "guided", 60);
  const Event* accident = log.find(EventKind::kAccident);
  ASSERT_NE(accident, nullptr);
  EXPECT_LT(accident->time.seconds(), 30);
  EXPECT_NE(log.find(EventKind::kLeft), nullptr);
}

TEST(Failsafe, AGliderWithoutPowerGlidesDown) {
  const Trouble dead{"battery", "{kind: battery, at_s: 20}", "", 0.8, {}, {}};
  for (const char* mode : {"guided", "auto"}) {
    const FlightLog log = fly_into(dead, kBixler, mode, 250);
    EXPECT_LE(since(log, FailsafeReaction::kDescend), kFault + 0.9);
    expect_end(log, FailsafeReaction::kDescend, false);
  }
}

TEST(Failsafe, ALowBatteryAndACriticalOneBringItHomeAndDown) {
  // Limits that are reached early: the reserve within minutes.
  const Trouble low{"low", "", "failsafe: {battery_reserve: 0.9}", 0, {}, {}};
  const Trouble critical{"critical", "", "failsafe: {battery_critical_charge: 0.97}",
                         0,          {}, {}};
  for (const char* plant : {kBixler, kQuad}) {
    SCOPED_TRACE(plant);
    const bool quad = plant == kQuad;
    const FlightLog home = fly_into(low, plant, "auto", 400);
    EXPECT_TRUE(reported(home, FailsafeTrigger::kBattery));
    expect_end(home, FailsafeReaction::kLand, quad);

    const FlightLog down = fly_into(critical, plant, "auto", 400);
    // As the battery monitor counts, whose error is 1 %.
    double below = -1;
    for (const FlightRow& row : down.rows.at(1))
      if (below < 0 && row.status.charge < 0.97) below = row.time.seconds();
    EXPECT_NEAR(since(down, FailsafeReaction::kLand), below + 3, 2 * kStep);
    expect_end(down, FailsafeReaction::kLand, quad);
    EXPECT_LT(geo::horizontal(down.rows.at(1).back().truth.p_N).norm(), quad ? 3 : 200);
  }
}

TEST(Failsafe, TurnsBackAtTheFence) {
  const Trouble fence{
      "fence",
      "",
      "fence: {areas_m: [[[-400, -400], [300, -400], [300, 400], [-400, 400]]]}",
      0,
      {},
      {}};
  for (const char* plant : {kBixler, kQuad})
    for (const char* mode : {"guided", "auto"}) {
      SCOPED_TRACE(fmt::format("{} {}", plant, mode));
      const FlightLog log = fly_into(fence, plant, mode, 300);
      double out = -1, furthest = 0;
      for (const FlightRow& row : log.rows.at(1)) {
        if (out < 0 && row.nav.p_N.x() > 300) out = row.time.seconds();
        furthest = std::max(furthest, row.truth.p_N.x());
      }
      // It may see the fence coming, and need not go out at all.
      const double at = since(log, FailsafeReaction::kReturn);
      EXPECT_GT(at, 0);
      if (out > 0) {
        EXPECT_LE(at, out + 0.2 + 2 * kStep);
      }
      // It looks ahead as far as a turn or a stop takes; the position is off by metres.
      EXPECT_LT(furthest, 310);
      expect_end(log, FailsafeReaction::kReturn, plant == kQuad);
    }
}

TEST(Failsafe, ThePilotTakesOverFromAFailsafeAndHandsBackToIt) {
  for (const char* plant : {kBixler, kQuad}) {
    SCOPED_TRACE(plant);
    // The link has been lost for longer than its delay when the pilot takes over.
    const Trouble link{"link", "{kind: link, at_s: 8}", "", 5, {}, {}};
    const FlightLog log = fly_into(link, plant, "stabilized", 250);
    const double at = since(log, FailsafeReaction::kReturn);
    EXPECT_LE(at, 13 + kStep);
    const Event* taken = log.find(EventKind::kMode, "stabilized");
    ASSERT_NE(taken, nullptr);
    EXPECT_NEAR(taken->time.seconds(), kTakesOver + kStep, 1e-9);
    for (const FlightRow& row : log.rows.at(1)) {
      const double t = row.time.seconds();
      if (t > kTakesOver + kStep && t < kHandsBack) {
        EXPECT_EQ(row.status.reaction, FailsafeReaction::kNone) << t;
      }
      if (t > kHandsBack + kStep) {
        EXPECT_EQ(row.status.reaction, FailsafeReaction::kReturn) << t;
      }
    }
    expect_end(log, FailsafeReaction::kReturn, plant == kQuad);
  }
}

}  // namespace
}  // namespace skein::assemble::failsafe_flight_test
