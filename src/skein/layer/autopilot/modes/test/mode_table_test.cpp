// SPDX-License-Identifier: Apache-2.0
// Every trigger in every situation for both airframes, with the defaults: what is done,
// and how long after the fault it is done.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "skein/layer/autopilot/modes/test/cockpit.h"

namespace skein::autopilot::mode_table_test {
namespace {

constexpr double kStep = 0.01;

struct Situation {
  const char* name;
  bool on_ground;
  bool pilot_flies;
  void (*reach)(Cockpit&);
};

const Situation kSituations[] = {
    {"holding, nothing commanded", false, false, [](Cockpit&) {}},
    {"guided", false, false, [](Cockpit& c) { c.command(CommandKind::kGuided); }},
    {"auto, mission", false, false, [](Cockpit& c) { c.command(CommandKind::kMission); }},
    {"auto, landing", false, false, [](Cockpit& c) { c.command(CommandKind::kLand); }},
    {"auto, take-off in the air", false, false,
     [](Cockpit& c) {
       c.in.on_ground = true;
       c.run(1);
       c.command(CommandKind::kTakeOff);
       c.in.on_ground = false;
       c.step();
     }},
    {"auto, take-off run", true, false,
     [](Cockpit& c) { c.command(CommandKind::kTakeOff); }},
    {"ready on the ground", true, false, [](Cockpit&) {}},
    {"manual", false, true, [](Cockpit& c) { c.pilot(true, FlightMode::kManual); }},
    {"stabilized", false, true,
     [](Cockpit& c) { c.pilot(true, FlightMode::kStabilized); }},
    {"manual, on the ground", true, true,
     [](Cockpit& c) { c.pilot(true, FlightMode::kManual); }},
};

struct Fault {
  const char* name;
  Failsafe failsafe;
  void (*happen)(Cockpit&);
  double delay;  // as the defaults are meant [s]
  Order fixed_wing, multirotor;
};

const Fault kFaults[] = {
    {"link", Failsafe::kLink, [](Cockpit& c) { c.link = false; }, 5, Order::kReturn,
     Order::kReturn},
    {"battery low", Failsafe::kBatteryLow, [](Cockpit& c) { c.in.charge_home = 0.9; }, 3,
     Order::kLand, Order::kLand},
    {"geofence", Failsafe::kGeofence, [](Cockpit& c) { c.in.outside_fence = true; }, 0.2,
     Order::kReturn, Order::kReturn},
    {"GNSS", Failsafe::kGnss, [](Cockpit& c) { c.gnss = false; }, 2, Order::kHold,
     Order::kDescend},
    {"estimator", Failsafe::kGnss, [](Cockpit& c) { c.in.estimator_healthy = false; }, 2,
     Order::kHold, Order::kDescend},
    {"battery critical", Failsafe::kBatteryCritical,
     [](Cockpit& c) { c.in.charge = 0.07; }, 3, Order::kLand, Order::kLand},
    {"motor", Failsafe::kMotor, [](Cockpit& c) { c.in.motor_failed = true; }, 0,
     Order::kDescend, Order::kDescend},
    {"inertial unit", Failsafe::kImu, [](Cockpit& c) { c.in.imu_lost = true; }, 0,
     Order::kDescend, Order::kDescend},
};

class EveryCase : public testing::TestWithParam<AirframeKind> {};

TEST_P(EveryCase, LeadsToItsReactionInTime) {
  double latest = 0;
  for (const Situation& situation : kSituations)
    for (const Fault& fault : kFaults) {
      SCOPED_TRACE(std::string(situation.name) + ", " + fault.name);
      Cockpit c(situation.on_ground, {}, GetParam());
      situation.reach(c);
      c.run(1);
      const Order before = c.now().order;
      ASSERT_TRUE(c.now().raised.empty());
      const Time last_well = c.in.now;
      fault.happen(c);
      while (!c.step().raised.has(fault.failsafe)) {
        ASSERT_EQ(c.now().order, before);
        ASSERT_LE((c.in.now - last_well).seconds(), fault.delay + 2 * kStep);
      }
      // A step for the condition to be seen, one because silence must exceed its delay.
      const double reacted = (c.in.now - last_well).seconds();
      EXPECT_GE(reacted, fault.delay);
      EXPECT_LE(reacted, fault.delay + kStep + 1e-9);
      latest = std::max(latest, reacted - fault.delay);
      EXPECT_TRUE(c.now().raised_now.has(fault.failsafe));
      EXPECT_EQ(c.now().trigger, trigger_of(fault.failsafe));

      const Order in_the_air =
          GetParam() == AirframeKind::kFixedWing ? fault.fixed_wing : fault.multirotor;
      const Order reaction = situation.on_ground ? Order::kStand : in_the_air;
      if (situation.pilot_flies) {
        EXPECT_EQ(c.now().order, Order::kPilot);
        EXPECT_EQ(c.run(10).order, Order::kPilot);
        c.pilot(false);
      }
      EXPECT_EQ(c.now().order, reaction);
      EXPECT_EQ(c.now().state,
                situation.on_ground ? ArmingState::kDisarmed : ArmingState::kFlying);
      // From here, too, the pilot takes over within the step.
      EXPECT_EQ(c.pilot(true).order, Order::kPilot);
      EXPECT_EQ(c.pilot(false).order, reaction);
    }
  RecordProperty("latest_ms_after_delay", static_cast<int>(std::lround(latest * 1e3)));
}

INSTANTIATE_TEST_SUITE_P(Airframes, EveryCase,
                         testing::Values(AirframeKind::kFixedWing,
                                         AirframeKind::kMultirotor));

// feasible() in full: nothing impossible is ever asked for.
TEST(Feasible, CanBeFlown) {
  using enum FailsafeReaction;
  for (int k = 0; k < 5 * 32; ++k) {
    const auto setpoint = static_cast<FailsafeReaction>(k % 5);
    const Abilities a{
        .airframe = k / 5 % 2 ? AirframeKind::kMultirotor : AirframeKind::kFixedWing,
        .position = (k / 10 % 2) != 0,
        .motors = (k / 20 % 2) != 0,
        .attitude = (k / 40 % 2) != 0,
        .home_in_reach = (k / 80 % 2) != 0};
    const FailsafeReaction done = feasible(setpoint, a);
    SCOPED_TRACE(k);
    EXPECT_EQ(done == kNone, setpoint == kNone);
    if (setpoint == kDescend) {
      EXPECT_EQ(done, kDescend);
    }
    if (!a.motors || !a.attitude) {
      EXPECT_TRUE(done == kNone || done == kDescend);
    }
    if (!a.position) {
      EXPECT_TRUE(done != kReturn && done != kLand);
    }
    if (!a.position && a.airframe == AirframeKind::kMultirotor) {
      EXPECT_NE(done, kHold);
    }
    if (!a.home_in_reach) {
      EXPECT_NE(done, kLand);
    }
    if (a.motors && a.attitude && a.position && a.home_in_reach) {
      EXPECT_EQ(done, setpoint);
    }
    EXPECT_EQ(feasible(done, a), done);  // what is done needs no further fallback
  }
}

}  // namespace
}  // namespace skein::autopilot::mode_table_test
