// SPDX-License-Identifier: Apache-2.0
// A real vehicle to which something happens in flight: who has it then, what is said, and
// that nobody is overridden.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "skein/mixed/test/fake_run.h"

namespace skein::mixed::fake {
namespace {

// A flight with its events, and its failsafes as a run records them.
class Flown {
 public:
  Flown(Make make, double take_over_at) : run(make, {}) {
    go(take_over_at);
    EXPECT_TRUE(run.fake.flew) << log_text();
    EXPECT_EQ(run.fake.mode(), VehicleMode::kGuided) << log_text();
    modes_before_ = run.fake.commands[176];
  }

  void go(double seconds) {
    for (int k = 0; k < 10 * seconds; ++k) {
      run.run(0.1);
      const AutopilotStatus status = run.vehicle->status();
      const bool acts = status.trigger != FailsafeTrigger::kNone;
      if (status.trigger != trigger_ || (acts && status.reaction != reaction_)) {
        ++failsafes_;
        if (acts) why = std::string(status.held);
        if (acts) first_trigger = status.trigger;
      }
      trigger_ = status.trigger;
      reaction_ = status.reaction;
    }
  }

  // Nothing is heard of it, nor does it hear anything.
  void cut(bool cut) {
    Faults& faults = run.fake.faults;
    faults.deaf = cut;
    faults.silent_at = cut ? run.now.seconds() : -1;
    faults.silent_for = 1e6;
  }
  void fail_safe(const char* text = nullptr) {
    run.fake.critical = true;
    if (text != nullptr) run.fake.say(4, text);
    run.fake.change_mode(VehicleMode::kReturn);
  }
  void reboot(VehicleMode mode) {
    run.fake.faults.clock_jump_at = run.now.seconds();
    run.fake.faults.clock_jump = -20;
    run.fake.change_mode(mode);
  }

  // Changes of its status that are events "failsafe" of a run; its end is one.
  int failsafes() const { return failsafes_; }
  // Modes that it was asked for since the take-over.
  int modes_asked() { return run.fake.commands[176] - modes_before_; }
  bool is_commanded() const {
    return run.fake.mode() == VehicleMode::kGuided && run.fake.armed &&
           run.now - run.fake.last_setpoint < s(1);
  }
  std::string log_text() const { return run.log_text() + why; }

  FakeRun run;
  std::string why;
  FailsafeTrigger first_trigger = FailsafeTrigger::kNone;

 private:
  int failsafes_ = 0, modes_before_ = 0;
  FailsafeTrigger trigger_ = FailsafeTrigger::kNone;
  FailsafeReaction reaction_ = FailsafeReaction::kNone;
};

class RealVehicleInFlight : public testing::TestWithParam<Make> {};

INSTANTIATE_TEST_SUITE_P(Makes, RealVehicleInFlight,
                         testing::Values(Make::kArduPilot, Make::kPx4),
                         [](const auto& each) {
                           return each.param == Make::kPx4 ? "px4" : "ardupilot";
                         });

void expect_failsafe_kept(Flown& flown) {
  FakeRun& run = flown.run;
  EXPECT_EQ(flown.failsafes(), 1) << flown.log_text();
  EXPECT_EQ(flown.modes_asked(), 0) << flown.log_text();
  EXPECT_EQ(run.fake.mode(), VehicleMode::kReturn) << flown.log_text();
  EXPECT_EQ(run.fake.take_offs, 1)
      << "it takes off no more by itself" << flown.log_text();
  EXPECT_TRUE(run.fake.on_ground()) << flown.log_text();
  EXPECT_FALSE(obeys_orders(run.vehicle->status()));
  EXPECT_FALSE(run.vehicle->status().held.empty());
}

TEST_P(RealVehicleInFlight, AFailsafeWhileTheLinkIsDownIsKept) {
  Flown flown(GetParam(), 40);
  flown.cut(true);
  flown.go(8);
  flown.fail_safe("Battery 1 is critical");
  flown.go(8);
  flown.cut(false);
  flown.go(120);
  expect_failsafe_kept(flown);
  EXPECT_NE(flown.why.find("its state is critical"), std::string::npos) << flown.why;
}

TEST_P(RealVehicleInFlight, AFailsafeThatEndsInTheOutageIsNotUndone) {
  Flown flown(GetParam(), 40);
  flown.cut(true);
  flown.go(8);
  flown.fail_safe();
  flown.go(120);
  flown.cut(false);
  flown.go(120);
  expect_failsafe_kept(flown);
}

TEST_P(RealVehicleInFlight, AFailsafeHasItsReason) {
  Flown flown(GetParam(), 40);
  flown.fail_safe("Battery 1 is critical 9.41V used 12 mAh");
  flown.go(120);
  expect_failsafe_kept(flown);
  EXPECT_EQ(flown.first_trigger, FailsafeTrigger::kBattery);
  EXPECT_NE(flown.why.find("Battery 1 is critical"), std::string::npos) << flown.why;
}

TEST_P(RealVehicleInFlight, WhatIsHandedBackIsLedOn) {
  Flown flown(GetParam(), 40);
  flown.fail_safe();
  flown.go(10);
  ASSERT_TRUE(flown.run.vehicle->hand_back(flown.run.now).ok());
  flown.go(10);
  EXPECT_TRUE(flown.is_commanded()) << flown.log_text();
  EXPECT_EQ(flown.run.count(EventKind::kHandedBack), 1u) << flown.log_text();
}

TEST_P(RealVehicleInFlight, APilotsHoldIsNotTheAgents) {
  for (const bool down : {false, true}) {
    Flown flown(GetParam(), 40);
    if (down) flown.cut(true);
    flown.go(8);
    flown.run.fake.change_mode(VehicleMode::kHold);
    flown.go(8);
    flown.cut(false);
    flown.go(60);
    EXPECT_EQ(flown.run.fake.mode(), VehicleMode::kHold) << flown.log_text();
    EXPECT_EQ(flown.modes_asked(), 0) << flown.log_text();
    EXPECT_EQ(flown.run.count(EventKind::kModeChanged), 1u) << flown.log_text();
    EXPECT_EQ(flown.failsafes(), 0) << flown.log_text();
    flown.run.fake.change_mode(VehicleMode::kGuided);
    flown.go(10);
    EXPECT_TRUE(flown.is_commanded()) << flown.log_text();
    EXPECT_EQ(flown.run.count(EventKind::kHandedBack), 1u) << flown.log_text();
  }
}

TEST_P(RealVehicleInFlight, WithoutSatellitesItIsLedNowhereUntilTheyAreBack) {
  Flown flown(GetParam(), 40);
  flown.run.fake.faults.no_fix = true;
  flown.go(1);
  const int before = flown.run.fake.setpoints;
  flown.go(40);
  EXPECT_LE(flown.run.fake.setpoints, before + 1) << flown.log_text();
  EXPECT_FALSE(obeys_orders(flown.run.vehicle->status()));
  flown.run.fake.faults.no_fix = false;
  flown.go(10);
  EXPECT_TRUE(flown.is_commanded()) << flown.log_text();
  EXPECT_EQ(flown.run.count(EventKind::kPositionLost), 1u) << flown.log_text();
  EXPECT_EQ(flown.run.count(EventKind::kPositionBack), 1u) << flown.log_text();
  EXPECT_EQ(flown.run.count(EventKind::kNotCommandable), 0u) << flown.log_text();
}

// What happens in a flight, at random; the events that name it, each once.
struct Happening {
  std::string what;
  std::vector<EventKind> events;
  int failsafes = 0;
  enum class End { kCommanded, kReturned, kPilots, kHolds } end = End::kCommanded;
};

class Happenings {
 public:
  explicit Happenings(unsigned seed) : random_(seed) {}

  Happening operator()(Flown& f) {
    using enum Happening::End;
    Faults& faults = f.run.fake.faults;
    const double wait = between(5, 20);
    switch (std::uniform_int_distribution<int>(0, 10)(random_)) {
      case 0:
        outage(f, [&] { f.fail_safe(); });
        return {"failsafe while the link is down", {EventKind::kLinkLost}, 1, kReturned};
      case 1:
        outage(f, [&] { f.run.fake.change_mode(VehicleMode::kHold); });
        return {"pilot's hold while the link is down",
                {EventKind::kLinkLost, EventKind::kModeChanged},
                0,
                kPilots};
      case 2:
        outage(f, [&] { f.run.fake.change_mode(VehicleMode::kStabilized); });
        return {"sticks while the link is down",
                {EventKind::kLinkLost, EventKind::kPilotTookOver},
                0,
                kPilots};
      case 3:
        outage(f, [] {});
        return {"the link is down", {EventKind::kLinkLost}, 0, kCommanded};
      case 4:
        f.fail_safe("Fence breached");
        return {"failsafe", {}, 1, kReturned};
      case 5:
        f.run.fake.change_mode(VehicleMode::kStabilized);
        f.go(wait);
        f.run.fake.change_mode(VehicleMode::kGuided);
        return {"sticks for a while",
                {EventKind::kPilotTookOver, EventKind::kHandedBack},
                0,
                kCommanded};
      case 6:
        faults.no_fix = true;
        f.go(wait);
        faults.no_fix = false;
        return {"no satellites for a while",
                {EventKind::kPositionLost, EventKind::kPositionBack},
                0,
                kCommanded};
      case 7:
        faults.no_fix = true;
        return {"no satellites any more", {EventKind::kPositionLost}, 0, kHolds};
      case 8:
        faults.position_jump_at = f.run.now.seconds();
        faults.position_jump.head<2>() = between(150, 5000) * geo::unit(between(0, 6.28));
        f.go(between(0.5, 1.5));  // for longer it is brought back
        faults.position_jump.setZero();
        return {"its position jumps and back",
                {EventKind::kPositionJumped, EventKind::kPositionBack},
                0,
                kCommanded};
      case 9:
        f.reboot(VehicleMode::kGuided);
        return {"it reboots and flies on", {EventKind::kVehicleRebooted}, 0, kCommanded};
      default:
        f.reboot(VehicleMode::kStabilized);
        return {"it reboots into sticks",
                {EventKind::kVehicleRebooted, EventKind::kPilotTookOver},
                0,
                kPilots};
    }
  }

  double between(double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(random_);
  }

 private:
  template <class Meanwhile>
  void outage(Flown& f, Meanwhile&& meanwhile) {
    f.cut(true);
    f.go(between(5, 20));
    meanwhile();
    f.go(between(2, 20));
    f.cut(false);
  }

  std::mt19937 random_;
};

// Whether it is where it should be in the end; empty: it is.
std::string misplaced(Flown& f, const Happening& happened) {
  using enum Happening::End;
  const FakeVehicle& fake = f.run.fake;
  switch (happened.end) {
    case kCommanded:
      return f.is_commanded() ? "" : "not commanded";
    case kReturned:
      return fake.mode() == VehicleMode::kReturn && fake.on_ground() ? "" : "overridden";
    case kPilots:
      return fake.mode() != VehicleMode::kGuided && f.modes_asked() == 0 ? ""
                                                                         : "overridden";
    case kHolds:
      return f.run.now - fake.last_setpoint > s(30) && !fake.on_ground() ? "" : "led";
  }
  return {};
}

// 100 of each make: none is led away or overridden, each happening is named once.
TEST_P(RealVehicleInFlight, AtRandomNoneIsOverriddenAndEachIsNamedOnce) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    Happenings happenings(seed);
    Flown flown(GetParam(), happenings.between(35, 80));
    const Happening happened = happenings(flown);
    flown.go(90);
    SCOPED_TRACE(happened.what + ", seed " + std::to_string(seed) + "\n" +
                 flown.log_text());
    EXPECT_EQ(misplaced(flown, happened), "");
    EXPECT_LT(flown.run.fake.furthest, 2 * FakeRun::kLeg);
    EXPECT_EQ(flown.failsafes(), happened.failsafes);
    for (const EventKind kind : happened.events)
      EXPECT_EQ(flown.run.count(kind), 1u) << row_of(kind).name;
    for (const EventKind kind : {EventKind::kNotCommandable, EventKind::kNotBroughtBack,
                                 EventKind::kRequestDenied})
      EXPECT_EQ(flown.run.count(kind), 0u) << row_of(kind).name;
  }
}

}  // namespace
}  // namespace skein::mixed::fake
