// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/control_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace skein::mixed::control_monitor_test {
namespace {

using Holder = ControlMonitor::Holder;
using Kind = LinkChange::Kind;

struct Flight {
  explicit Flight(bool hovers) : control(hovers) {
    control.hear(LinkChange{Kind::kUp, {}});
  }

  void see(VehicleMode mode, const char* name, bool on_ground = false) {
    condition.mode = mode;
    condition.mode_name = name;
    condition.on_ground = on_ground;
    now = now + Time::from_seconds(1);
    control.step(now, condition, lands, events);
  }
  void outage() {
    control.hear(LinkChange{Kind::kDown, {}});
    control.hear(LinkChange{Kind::kUp, {}});
  }
  std::size_t reported(EventKind kind) const {
    return static_cast<std::size_t>(
        std::ranges::count(events, kind, &VehicleEvent::kind));
  }

  ControlMonitor control;
  VehicleCondition condition;
  std::vector<VehicleEvent> events;
  bool lands = false;
  Time now;
};

// In the air, guided, as was asked for.
Flight guided(bool hovers = true) {
  Flight f(hovers);
  f.see(VehicleMode::kHold, "LOITER");
  f.control.sent(ModeRequest{VehicleMode::kGuided});
  f.see(VehicleMode::kGuided, "GUIDED");
  EXPECT_FALSE(f.control.is_taken());
  return f;
}

TEST(ControlMonitor, AHoldThatNobodyHereAskedForIsAPilots) {
  for (const bool down : {false, true}) {
    Flight f = guided();
    if (down) f.outage();
    f.see(VehicleMode::kHold, "LOITER");
    EXPECT_EQ(f.control.holder(), Holder::kOther);
    EXPECT_EQ(f.control.reaction(), FailsafeReaction::kHold);
    EXPECT_EQ(f.control.trigger(), FailsafeTrigger::kNone);
    EXPECT_EQ(f.reported(EventKind::kModeChanged), 1u);
    f.see(VehicleMode::kHold, "LOITER");
    EXPECT_EQ(f.reported(EventKind::kModeChanged), 1u);
    f.see(VehicleMode::kGuided, "GUIDED");
    EXPECT_FALSE(f.control.is_taken());
    EXPECT_EQ(f.reported(EventKind::kHandedBack), 1u);
  }
}

TEST(ControlMonitor, WhatWasAskedForIsTheAgentsAlsoAfterAnOutage) {
  Flight f = guided();
  f.control.sent(LandRequest{});
  f.outage();
  f.see(VehicleMode::kLand, "LAND");
  EXPECT_FALSE(f.control.is_taken());
  f.see(VehicleMode::kMission, "AUTO");  // a multirotor lands in a mode of its own
  EXPECT_TRUE(f.control.is_taken());
}

TEST(ControlMonitor, WhatWasDeniedWasNotTakenUp) {
  Flight f = guided();
  f.control.sent(LandRequest{});
  f.control.denied();
  f.see(VehicleMode::kLand, "LAND");
  EXPECT_TRUE(f.control.is_taken());
}

TEST(ControlMonitor, ATakeOffMayEndInHolding) {
  Flight f(true);
  f.see(VehicleMode::kHold, "AUTO.LOITER", true);
  f.control.sent(TakeOffRequest{});
  f.see(VehicleMode::kTakeOff, "AUTO.TAKEOFF");
  f.see(VehicleMode::kHold, "AUTO.LOITER");
  f.outage();
  f.see(VehicleMode::kHold, "AUTO.LOITER");
  EXPECT_FALSE(f.control.is_taken());
}

TEST(ControlMonitor, WhoTakesOffByHandHasIt) {
  Flight f(true);
  f.see(VehicleMode::kHold, "LOITER", true);
  EXPECT_FALSE(f.control.is_taken());
  f.see(VehicleMode::kHold, "LOITER");
  EXPECT_TRUE(f.control.is_taken());
}

TEST(ControlMonitor, SaysWhyAFailsafeActs) {
  struct Case {
    const char* text;
    FailsafeTrigger trigger;
  };
  for (const Case& each :
       {Case{"Battery 1 is critical 9.41V used 12 mAh", FailsafeTrigger::kBattery},
        Case{"Failsafe. Long event on: GCS", FailsafeTrigger::kLink},
        Case{"Fence breached", FailsafeTrigger::kGeofence},
        Case{"EKF failsafe", FailsafeTrigger::kGnss},
        Case{"something else", FailsafeTrigger::kUnknown}}) {
    Flight f = guided(false);
    f.control.hear(VehicleText{4, each.text}, f.now);
    f.see(VehicleMode::kReturn, "RTL");
    EXPECT_EQ(f.control.holder(), Holder::kFailsafe);
    EXPECT_EQ(f.control.trigger(), each.trigger) << each.text;
    EXPECT_EQ(f.control.reaction(), FailsafeReaction::kReturn);
    EXPECT_NE(f.control.why().find(each.text), std::string::npos) << f.control.why();
  }
}

TEST(ControlMonitor, WithoutAReasonItSaysWhatIsKnown) {
  Flight f = guided(false);
  f.outage();
  f.condition.emergency = true;
  f.condition.voltage = 9;
  f.see(VehicleMode::kReturn, "RTL");
  EXPECT_EQ(f.control.trigger(), FailsafeTrigger::kUnknown);
  EXPECT_NE(f.control.why().find("since its link was down"), std::string::npos);
  EXPECT_NE(f.control.why().find("9.0 V"), std::string::npos);
}

// Its own failsafe has landed it: it does not take off again by itself.
TEST(ControlMonitor, AFlightThatEndedOtherwiseIsNotTheAgentsAnyMore) {
  Flight f = guided(true);
  f.outage();
  f.see(VehicleMode::kReturn, "RTL", true);
  EXPECT_TRUE(f.control.is_taken());
  ASSERT_TRUE(f.control.hand_back().ok());
  f.see(VehicleMode::kReturn, "RTL", true);
  EXPECT_FALSE(f.control.is_taken());
}

TEST(ControlMonitor, AModeOnTheGroundAfterItsLandingIsNobodys) {
  Flight f = guided(true);
  f.control.sent(LandRequest{});
  f.lands = true;
  f.see(VehicleMode::kLand, "LAND");
  f.see(VehicleMode::kLand, "LAND", true);
  f.see(VehicleMode::kStabilized, "STABILIZE", true);
  EXPECT_FALSE(f.control.is_taken());
}

TEST(ControlMonitor, AVehicleThatReturnsWhenItIsFirstHeardIsLeftAlone) {
  Flight f(false);
  f.see(VehicleMode::kReturn, "RTL");
  EXPECT_EQ(f.control.holder(), Holder::kFailsafe);
  Flight holds(false);
  holds.see(VehicleMode::kHold, "LOITER");
  EXPECT_FALSE(holds.control.is_taken());
}

TEST(ControlMonitor, NothingThatWasAskedForSurvivesAReboot) {
  Flight f = guided(false);
  f.control.sent(LandRequest{});
  f.control.hear(LinkChange{Kind::kRebooted, {}});
  f.see(VehicleMode::kMission, "AUTO");
  EXPECT_TRUE(f.control.is_taken());
}

}  // namespace
}  // namespace skein::mixed::control_monitor_test
