// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/mode_logic.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/layer/autopilot/modes/test/cockpit.h"

namespace skein::autopilot::mode_logic_test {
namespace {

TEST(ModeLogic, NothingHappensInAnHourWithoutFaults) {
  Cockpit c;
  c.command(CommandKind::kMission);
  c.step();
  for (int k = 0; k < 360'000; ++k) {
    const Decision& d = c.step();
    ASSERT_TRUE(d.events.empty()) << k;
    ASSERT_EQ(d.order, Order::kAgent);
  }
}

TEST(ModeLogic, WhatIsNotFittedIsNotMissed) {
  Cockpit c;
  c.link = c.gnss = false;
  c.in.link_heard = c.in.gnss_fix = kNotFitted;
  EXPECT_TRUE(c.run(1000).raised.empty());
}

TEST(ModeLogic, HoldsInTheAirUntilTheFirstCommand) {
  Cockpit c;
  EXPECT_EQ(c.now().order, Order::kHold);
  EXPECT_EQ(c.now().state, ArmingState::kFlying);
  EXPECT_EQ(c.command(CommandKind::kGuided).order, Order::kAgent);
  EXPECT_EQ(c.now().mode, FlightMode::kGuided);
  EXPECT_EQ(c.command(CommandKind::kMission).mode, FlightMode::kAuto);
  EXPECT_TRUE(c.now().events.has(ModeEvent::kModeChanged));
  // The same order, but another command.
  EXPECT_TRUE(c.command(CommandKind::kMission).events.has(ModeEvent::kOrderChanged));
  EXPECT_FALSE(c.step().events.has(ModeEvent::kOrderChanged));
}

TEST(ModeLogic, KindsOfCommands) {
  const auto kind = [](auto guidance) {
    return kind_of(AutopilotCommand{.guidance = guidance});
  };
  EXPECT_EQ(kind(FollowPath{}), CommandKind::kGuided);
  EXPECT_EQ(kind(HoldCourse{}), CommandKind::kGuided);
  EXPECT_EQ(kind(Circle{}), CommandKind::kGuided);
  EXPECT_EQ(kind(HoldPosition{}), CommandKind::kGuided);
  EXPECT_EQ(kind(FollowPlan{}), CommandKind::kMission);
  EXPECT_EQ(kind(FlyWaypoints{}), CommandKind::kMission);
  EXPECT_EQ(kind(Return{}), CommandKind::kMission);
  EXPECT_EQ(kind(TakeOff{}), CommandKind::kTakeOff);
  EXPECT_EQ(kind(Land{}), CommandKind::kLand);
}

TEST(ModeLogic, FliesFromGroundToGround) {
  Cockpit c(true);
  EXPECT_EQ(c.now().state, ArmingState::kReady);
  EXPECT_EQ(c.command(CommandKind::kMission).order, Order::kStand);
  EXPECT_EQ(c.command(CommandKind::kTakeOff).order, Order::kTakeOff);
  EXPECT_TRUE(c.now().events.has(ModeEvent::kTookOff));
  EXPECT_EQ(c.run(5).order, Order::kTakeOff);  // the run, on the ground
  c.in.on_ground = false;
  // What comes during the climb waits for its end.
  EXPECT_EQ(c.command(CommandKind::kMission).order, Order::kTakeOff);
  c.in.done = true;
  EXPECT_EQ(c.step().order, Order::kAgent);
  c.in.done = false;
  EXPECT_EQ(c.command(CommandKind::kLand).order, Order::kAgent);
  c.in.on_ground = true;
  EXPECT_EQ(c.step().state, ArmingState::kFlying);  // rolls out
  c.in.landed = true;
  EXPECT_EQ(c.step().state, ArmingState::kLanded);
  EXPECT_EQ(c.now().order, Order::kStand);
  EXPECT_TRUE(c.now().events.has(ModeEvent::kLanded));
  c.in.landed = false;
  EXPECT_EQ(c.run(10).order, Order::kStand);
  EXPECT_EQ(c.command(CommandKind::kTakeOff).order, Order::kTakeOff);
}

TEST(ModeLogic, ATouchOfTheGroundIsNoLanding) {
  Cockpit c;
  c.command(CommandKind::kMission);
  for (int bounce = 0; bounce < 20; ++bounce) {
    c.in.on_ground = true;
    EXPECT_EQ(c.run(0.4).state, ArmingState::kFlying);
    c.in.on_ground = false;
    EXPECT_EQ(c.run(0.2).state, ArmingState::kFlying);
  }
  c.in.on_ground = true;
  EXPECT_EQ(c.run(0.6).state, ArmingState::kLanded);
}

TEST(ModeLogic, DoesNotTakeOffUnderAFailsafe) {
  Cockpit c(true);
  c.in.outside_fence = true;
  EXPECT_EQ(c.run(1).state, ArmingState::kDisarmed);
  EXPECT_TRUE(c.command(CommandKind::kTakeOff).events.has(ModeEvent::kTakeOffRefused));
  EXPECT_EQ(c.now().order, Order::kStand);
  c.in.outside_fence = false;
  EXPECT_EQ(c.run(3).state, ArmingState::kReady);  // but it does not start by itself
  EXPECT_EQ(c.command(CommandKind::kTakeOff).order, Order::kTakeOff);
}

TEST(ModeLogic, AFailsafeBreaksOffATakeOffRun) {
  Cockpit c(true);
  c.command(CommandKind::kTakeOff);
  c.run(1);
  c.in.motor_failed = true;
  EXPECT_EQ(c.step().order, Order::kStand);
  EXPECT_EQ(c.now().state, ArmingState::kDisarmed);
  EXPECT_TRUE(c.now().events.has(ModeEvent::kTakeOffRefused));
}

TEST(ModeLogic, LinkLossEndsWithTheMissionResumed) {
  Cockpit c;
  c.command(CommandKind::kGuided);
  c.link = false;
  EXPECT_EQ(c.run(4.9).order, Order::kAgent);
  EXPECT_EQ(c.run(0.2).order, Order::kReturn);
  EXPECT_EQ(c.now().trigger, FailsafeTrigger::kLink);
  EXPECT_EQ(c.now().reaction, FailsafeReaction::kReturn);
  EXPECT_EQ(c.now().mode, FlightMode::kAuto);
  c.link = true;
  EXPECT_EQ(c.run(1.9).order, Order::kReturn);
  EXPECT_EQ(c.run(0.2).order, Order::kAgent);
  EXPECT_EQ(c.now().mode, FlightMode::kGuided);
  EXPECT_EQ(c.now().trigger, FailsafeTrigger::kNone);
}

TEST(ModeLogic, WithoutResumingANewCommandEndsTheFailsafe) {
  FailsafeOptions options;
  options.link.resumes = false;
  Cockpit c(false, options);
  c.command(CommandKind::kMission);
  c.link = false;
  c.run(6);
  c.command(CommandKind::kGuided);  // while the condition is there: kept only
  EXPECT_EQ(c.now().order, Order::kReturn);
  c.link = true;
  EXPECT_EQ(c.run(60).order, Order::kReturn);
  EXPECT_EQ(c.command(CommandKind::kMission).order, Order::kAgent);
}

TEST(ModeLogic, AFenceThatIsLeftAgainAndAgainIsNotForgivenForEver) {
  Cockpit c;
  int back = 0;
  for (int time = 0; time < 20; ++time) {
    c.command(CommandKind::kMission);
    c.in.outside_fence = true;
    EXPECT_EQ(c.run(0.5).order, Order::kReturn);
    c.in.outside_fence = false;
    EXPECT_EQ(c.run(5).order, Order::kReturn);
    back += c.command(CommandKind::kMission).order == Order::kAgent;
  }
  EXPECT_EQ(back, FailsafeOptions{}.max_clears);
}

TEST(ModeLogic, ALowBatteryLandsAtHome) {
  Cockpit c;
  c.command(CommandKind::kMission);
  c.in.charge_home = 0.2;
  c.in.charge = 0.34;
  EXPECT_EQ(c.run(3.1).order, Order::kLand);
  EXPECT_EQ(c.now().trigger, FailsafeTrigger::kBattery);
}

TEST(ModeLogic, BatteryGoesFromBadToWorse) {
  FailsafeOptions options;
  options.battery_low.reaction = FailsafeReaction::kReturn;
  Cockpit c(false, options);
  c.command(CommandKind::kMission);
  c.in.charge_home = 0.2;
  c.in.charge = 0.34;
  EXPECT_EQ(c.run(3.1).order, Order::kReturn);
  EXPECT_EQ(c.now().trigger, FailsafeTrigger::kBattery);
  c.in.charge_home = 0;  // at home
  EXPECT_EQ(c.run(60).order, Order::kReturn);
  EXPECT_EQ(c.command(CommandKind::kMission).order, Order::kReturn);
  c.in.charge = 0.07;
  EXPECT_EQ(c.run(3.1).order, Order::kLand);
  c.in.charge = 0.5;
  EXPECT_EQ(c.run(60).order, Order::kLand);
}

TEST(ModeLogic, CriticalBatteryFarFromHomeDescendsAndStaysWithIt) {
  Cockpit c;
  c.in.charge = 0.07;
  c.in.charge_home = 0.1;
  EXPECT_EQ(c.run(3.1).order, Order::kDescend);
  c.in.charge_home = 0.06;  // the wind has turned
  EXPECT_EQ(c.run(10).order, Order::kDescend);
}

TEST(ModeLogic, ALandingAtHomeBecomesADescentWhenHomeIsOutOfReach) {
  Cockpit c;
  c.in.charge = 0.07;
  c.in.charge_home = 0.05;
  EXPECT_EQ(c.run(3.1).reaction, FailsafeReaction::kLand);
  c.in.charge_home = 0.07;  // just enough
  EXPECT_EQ(c.run(5).reaction, FailsafeReaction::kLand);
  c.in.charge_home = 0.071;
  EXPECT_EQ(c.step().reaction, FailsafeReaction::kDescend);
  EXPECT_EQ(c.now().order, Order::kDescend);
  EXPECT_TRUE(c.now().events.has(ModeEvent::kReactionChanged));
  EXPECT_EQ(c.now().trigger, FailsafeTrigger::kBattery);
}

TEST(ModeLogic, ALowBatteryAloneDoesNotGiveUpTheReturn) {
  Cockpit c;
  c.in.charge = 0.2;
  c.in.charge_home = 0.3;
  EXPECT_EQ(c.run(60).reaction, FailsafeReaction::kLand);
  c.in.charge = 0.07;  // critical
  EXPECT_EQ(c.run(3.1).reaction, FailsafeReaction::kDescend);
}

TEST(ModeLogic, AChargeThatIsNoNumberCountsAsBad) {
  Cockpit c;
  c.in.charge = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(c.run(3.1).trigger, FailsafeTrigger::kBattery);
}

TEST(ModeLogic, WithoutPositionAFixedWingCirclesThenComesDown) {
  Cockpit c;
  c.command(CommandKind::kMission);
  c.gnss = false;
  EXPECT_EQ(c.run(1.9).order, Order::kAgent);
  EXPECT_EQ(c.run(0.2).order, Order::kHold);
  EXPECT_TRUE(c.now().without_position);
  EXPECT_EQ(c.run(59.8).order, Order::kHold);
  EXPECT_EQ(c.run(0.3).order, Order::kDescend);
  c.gnss = true;
  EXPECT_EQ(c.run(2.1).order, Order::kAgent);
}

TEST(ModeLogic, WithoutPositionAMultirotorComesDownAtOnce) {
  Cockpit c(false, {}, AirframeKind::kMultirotor);
  c.in.estimator_healthy = false;
  EXPECT_EQ(c.run(2.1).order, Order::kDescend);
  EXPECT_EQ(c.now().reaction, FailsafeReaction::kDescend);
}

TEST(ModeLogic, TheMoreSevereTriggerDecides) {
  Cockpit c;
  c.link = false;
  EXPECT_EQ(c.run(6).trigger, FailsafeTrigger::kLink);
  c.in.charge = 0.1;
  EXPECT_EQ(c.run(4).trigger, FailsafeTrigger::kBattery);
  c.in.outside_fence = true;
  EXPECT_EQ(c.run(1).trigger, FailsafeTrigger::kGeofence);
  c.gnss = false;
  EXPECT_EQ(c.run(3).trigger, FailsafeTrigger::kGnss);
  EXPECT_EQ(c.now().order, Order::kHold);
  c.in.charge = 0.05;
  EXPECT_EQ(c.run(4).trigger, FailsafeTrigger::kBattery);
  EXPECT_EQ(c.now().order, Order::kDescend);  // no return without a position
  c.in.motor_failed = true;
  EXPECT_EQ(c.step().trigger, FailsafeTrigger::kMotor);
  EXPECT_TRUE(c.now().without_motor);
}

TEST(ModeLogic, WhatIsOnlyReportedDoesNotHideALesserFailsafe) {
  FailsafeOptions options;
  options.geofence.reaction = FailsafeReaction::kNone;
  Cockpit c(false, options);
  c.command(CommandKind::kMission);
  c.in.outside_fence = true;
  EXPECT_EQ(c.run(1).trigger, FailsafeTrigger::kGeofence);
  EXPECT_EQ(c.now().order, Order::kAgent);
  c.link = false;
  EXPECT_EQ(c.run(6).trigger, FailsafeTrigger::kLink);
  EXPECT_EQ(c.now().order, Order::kReturn);
}

TEST(ModeLogic, ALandingTooFarOnIsFinished) {
  Cockpit c;
  c.command(CommandKind::kLand);
  c.in.committed = true;
  c.link = false;
  EXPECT_EQ(c.run(6).order, Order::kAgent);
  EXPECT_EQ(c.now().trigger, FailsafeTrigger::kLink);
  EXPECT_EQ(c.now().reaction, FailsafeReaction::kLand);
  c.in.committed = false;
  EXPECT_EQ(c.step().order, Order::kReturn);
}

TEST(ModeLogic, PilotTakesOverAndHandsBackWithinAStep) {
  Cockpit c;
  c.command(CommandKind::kGuided);
  EXPECT_EQ(c.pilot(true, FlightMode::kManual).order, Order::kPilot);
  EXPECT_EQ(c.now().mode, FlightMode::kManual);
  EXPECT_TRUE(c.now().events.has(ModeEvent::kPilotTookOver));
  EXPECT_EQ(c.pilot(true, FlightMode::kStabilized).mode, FlightMode::kStabilized);
  // An auto mode is none of the transmitter's.
  EXPECT_EQ(c.pilot(true, FlightMode::kAuto).mode, FlightMode::kStabilized);
  c.command(CommandKind::kMission);
  EXPECT_EQ(c.now().order, Order::kPilot);
  EXPECT_EQ(c.pilot(false).order, Order::kAgent);  // by the newest command
  EXPECT_EQ(c.now().mode, FlightMode::kAuto);
  EXPECT_TRUE(c.now().events.has(ModeEvent::kPilotHandedBack));
}

TEST(ModeLogic, FailsafesWaitForThePilot) {
  Cockpit c;
  c.command(CommandKind::kMission);
  c.pilot(true);
  c.in.motor_failed = true;
  c.link = false;
  EXPECT_EQ(c.run(20).order, Order::kPilot);
  EXPECT_EQ(c.now().trigger, FailsafeTrigger::kMotor);
  EXPECT_EQ(c.now().reaction, FailsafeReaction::kNone);
  EXPECT_EQ(c.pilot(false).order, Order::kDescend);
  EXPECT_EQ(c.pilot(true).order, Order::kPilot);
}

TEST(ModeLogic, HandingBackInsideTheFenceResumesTheMission) {
  Cockpit c;
  c.command(CommandKind::kMission);
  c.in.outside_fence = true;
  EXPECT_EQ(c.run(1).order, Order::kReturn);
  c.pilot(true);
  c.in.outside_fence = false;
  c.run(5);
  EXPECT_EQ(c.pilot(false).order, Order::kAgent);
}

TEST(ModeLogic, ASilentTransmitterInThePilotsHandsIsALostLink) {
  Cockpit c;
  c.command(CommandKind::kMission);
  c.pilot(true);
  c.transmitter = false;
  EXPECT_EQ(c.run(0.5).order, Order::kPilot);
  EXPECT_EQ(c.step().order, Order::kHold);  // somebody must fly
  EXPECT_TRUE(c.now().events.has(ModeEvent::kPilotLost));
  EXPECT_EQ(c.run(4.4).order, Order::kHold);
  EXPECT_EQ(c.run(0.2).order, Order::kReturn);
  EXPECT_EQ(c.now().trigger, FailsafeTrigger::kLink);
  EXPECT_EQ(c.command(CommandKind::kGuided).order, Order::kReturn);
  c.transmitter = true;
  EXPECT_EQ(c.step().order, Order::kPilot);
  EXPECT_EQ(c.run(3).trigger, FailsafeTrigger::kNone);
}

TEST(ModeLogic, ASilentTransmitterOfAPilotWhoDoesNotFlyIsNothing) {
  Cockpit c;
  c.command(CommandKind::kMission);
  c.pilot(false);
  c.transmitter = false;
  EXPECT_EQ(c.run(60).order, Order::kAgent);
  EXPECT_TRUE(c.now().raised.empty());
}

TEST(ModeLogic, ThePilotMayFlyFromTheGroundAndBackToIt) {
  Cockpit c(true);
  c.in.outside_fence = true;
  c.run(1);
  EXPECT_EQ(c.pilot(true).order, Order::kPilot);
  EXPECT_EQ(c.pilot(false).order, Order::kStand);  // the motors stop
  c.pilot(true);
  c.in.on_ground = false;
  c.in.outside_fence = false;
  c.run(5);
  EXPECT_EQ(c.pilot(false).order, Order::kHold);
  c.pilot(true);
  c.in.on_ground = true;
  c.run(1);
  EXPECT_EQ(c.pilot(false).state, ArmingState::kLanded);
}

TEST(FailsafeOptions, SayWhatIsWrongWithThem) {
  EXPECT_FALSE(error_in(FailsafeOptions{}));
  const auto error_of = [](auto change) {
    FailsafeOptions options;
    change(options);
    return error_in(options).value_or("");
  };
  using O = FailsafeOptions;
  const auto names = [](const std::string& fault, const char* field) {
    return fault.find(field) == 0;
  };
  EXPECT_TRUE(names(error_of([](O& o) { o.gnss.delay = -1; }), "gnss.delay"));
  EXPECT_TRUE(names(error_of([](O& o) {
                      o.link.escalates_after = 5;
                      o.link.escalates_to = FailsafeReaction::kHold;
                    }),
                    "link.escalates_to"));
  EXPECT_TRUE(names(error_of([](O& o) { o.recovery = 1e9; }), "recovery"));
  EXPECT_TRUE(names(error_of([](O& o) { o.battery_reserve = 1.1; }), "battery_reserve"));
  EXPECT_TRUE(names(error_of([](O& o) { o.max_clears = -1; }), "max_clears"));
  EXPECT_TRUE(names(error_of([](O& o) {
                      o.motor.escalates_after = std::numeric_limits<double>::quiet_NaN();
                    }),
                    "motor.escalates_after"));
}

}  // namespace
}  // namespace skein::autopilot::mode_logic_test
