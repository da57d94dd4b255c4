// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/flight_director.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace skein::mixed::flight_director_test {
namespace {

using Outcome = RequestAnswer::Outcome;

// Keeps what is sent; answers are the test's.
struct Desk final : VehiclePort {
  void receive(Time, std::vector<VehicleReport>&) override {}
  void send(std::uint32_t number, const VehicleRequest& request) override {
    sent.emplace_back(number, request);
  }
  std::vector<std::pair<std::uint32_t, VehicleRequest>> sent;
};

struct Cockpit {
  explicit Cockpit(bool hovers = false) : director(hovers) {
    director.hear(LinkChange{LinkChange::Kind::kUp, {}});
  }
  void set(VehicleMode mode, const char* name, bool armed, bool on_ground) {
    condition.mode = mode;
    condition.mode_name = name;
    condition.armed = armed;
    condition.on_ground = on_ground;
  }
  void run(double seconds) {
    for (int k = 0; k < 10 * seconds; ++k) {
      now = now + Time::from_seconds(0.1);
      director.step(now, condition, altitude, knows_position, desk, events);
    }
  }
  void answer(Outcome outcome, const char* text = "") {
    ASSERT_FALSE(desk.sent.empty());
    director.hear(RequestAnswer{desk.sent.back().first, outcome, text}, now, events);
  }
  template <class T>
  std::size_t count() const {
    return static_cast<std::size_t>(std::count_if(
        desk.sent.begin(), desk.sent.end(),
        [](const auto& each) { return std::holds_alternative<T>(each.second); }));
  }
  std::size_t reported(EventKind kind) const {
    return static_cast<std::size_t>(
        std::count_if(events.begin(), events.end(),
                      [&](const VehicleEvent& e) { return e.kind == kind; }));
  }

  FlightDirector director;
  Desk desk;
  VehicleCondition condition;
  double altitude = 0;
  bool knows_position = true;
  std::vector<VehicleEvent> events;
  Time now;
};

// Flies in the guided mode that was asked for.
Cockpit guided(bool hovers = false) {
  Cockpit c(hovers);
  c.set(VehicleMode::kHold, "LOITER", true, false);
  c.director.fly();
  c.run(1);
  c.answer(Outcome::kAccepted);
  c.set(VehicleMode::kGuided, "GUIDED", true, false);
  c.run(1);
  return c;
}

// It stands, is accepted, and only later says that it is armed, that it rolls, and that
// it is off the ground: at no height, so it still takes off.
TEST(FlightDirector, LetsItClimbWhateverTheOrderOfWhatItSays) {
  Cockpit c;
  c.set(VehicleMode::kManual, "MANUAL", false, true);
  c.director.take_off({100, {}});
  c.run(1);
  c.answer(Outcome::kAccepted);
  c.set(VehicleMode::kTakeOff, "TAKEOFF", false, true);
  c.run(0.5);
  c.set(VehicleMode::kTakeOff, "TAKEOFF", true, true);
  c.run(1);
  c.set(VehicleMode::kTakeOff, "TAKEOFF", true, false);
  c.director.fly();
  c.run(5);
  EXPECT_TRUE(c.director.taking_off());
  EXPECT_FALSE(c.director.takes_setpoints());
  EXPECT_EQ(c.count<TakeOffRequest>(), 1u);
  EXPECT_EQ(c.count<ModeRequest>(), 0u);
  c.altitude = 95;
  c.director.fly();
  c.run(1);
  EXPECT_TRUE(c.director.takes_setpoints());
}

TEST(FlightDirector, AsksToTakeOffAgainAndReportsADenialOnce) {
  Cockpit c;
  c.set(VehicleMode::kManual, "MANUAL", false, true);
  c.director.take_off({100, {}});
  c.run(1);
  EXPECT_EQ(c.count<TakeOffRequest>(), 1u);  // as long as there is no answer
  for (int k = 0; k < 5; ++k) {
    c.answer(Outcome::kDenied, "Arm: waiting for EKF");
    c.run(4);
  }
  EXPECT_EQ(c.count<TakeOffRequest>(), 6u);
  EXPECT_EQ(c.reported(EventKind::kTakeOffDenied), 1u);
  EXPECT_EQ(c.reported(EventKind::kPilotTookOver), 0u);  // manual, but on the ground
}

// Somebody chose another mode on the ground while the take-off was being asked for.
TEST(FlightDirector, LeavesItToWhoeverWithdrewItsTakeOff) {
  Cockpit c;
  c.set(VehicleMode::kManual, "MANUAL", false, true);
  c.director.take_off({100, {}});
  c.run(1);
  c.set(VehicleMode::kStabilized, "FBWA", false, true);
  c.answer(Outcome::kWithdrawn, "mode TAKEOFF: withdrawn");
  c.run(60);
  EXPECT_EQ(c.count<TakeOffRequest>(), 1u);
  EXPECT_EQ(c.reported(EventKind::kTakeOffDenied), 0u);
  EXPECT_EQ(c.reported(EventKind::kPilotTookOver), 1u);
  c.set(VehicleMode::kGuided, "GUIDED", false, true);
  c.run(5);
  EXPECT_EQ(c.count<TakeOffRequest>(), 2u) << "handed back";
}

TEST(FlightDirector, GoesOverToGuidedWhenItHasClimbed) {
  Cockpit c;
  c.set(VehicleMode::kManual, "MANUAL", false, true);
  c.director.take_off({100, {}});
  c.director.fly();  // waits for the end of the take-off
  c.run(1);
  c.answer(Outcome::kAccepted);
  c.set(VehicleMode::kTakeOff, "TAKEOFF", true, false);
  c.altitude = 50;
  c.run(2);
  EXPECT_EQ(c.count<ModeRequest>(), 0u);
  EXPECT_FALSE(c.director.takes_setpoints());
  c.altitude = 95;
  c.run(1);
  EXPECT_EQ(c.count<ModeRequest>(), 1u);
  EXPECT_TRUE(c.director.takes_setpoints());
}

TEST(FlightDirector, LeavesTheFlightToAPilotUntilItIsHandedBack) {
  Cockpit c = guided();
  EXPECT_TRUE(c.director.reached());
  const std::size_t before = c.desk.sent.size();
  c.set(VehicleMode::kStabilized, "FBWA", true, false);
  c.run(30);
  EXPECT_EQ(c.desk.sent.size(), before);
  EXPECT_FALSE(c.director.takes_setpoints());
  EXPECT_EQ(c.director.control().holder(), ControlMonitor::Holder::kPilot);
  EXPECT_EQ(c.reported(EventKind::kPilotTookOver), 1u);
  c.set(VehicleMode::kGuided, "GUIDED", true, false);
  c.run(1);
  EXPECT_EQ(c.reported(EventKind::kHandedBack), 1u);
  EXPECT_TRUE(c.director.takes_setpoints());
}

TEST(FlightDirector, LeavesAFailsafeAlone) {
  Cockpit c = guided();
  const std::size_t before = c.desk.sent.size();
  c.set(VehicleMode::kReturn, "RTL", true, false);
  c.run(30);
  EXPECT_EQ(c.desk.sent.size(), before);
  EXPECT_EQ(c.director.control().holder(), ControlMonitor::Holder::kFailsafe);
  EXPECT_EQ(c.director.control().reaction(), FailsafeReaction::kReturn);
}

// An outage after which it is in another mode.
Cockpit after_outage(VehicleMode mode, const char* name, bool hovers = false) {
  Cockpit c = guided(hovers);
  c.director.hear(LinkChange{LinkChange::Kind::kDown, {}});
  c.run(30);
  EXPECT_FALSE(c.director.takes_setpoints());
  c.set(mode, name, true, false);
  c.director.hear(LinkChange{LinkChange::Kind::kUp, {}});
  c.desk.sent.clear();
  c.run(30);
  return c;
}

TEST(FlightDirector, LeavesAloneWhatChangedWhileTheLinkWasDown) {
  for (const bool hovers : {false, true})
    for (const VehicleMode mode :
         {VehicleMode::kReturn, VehicleMode::kHold, VehicleMode::kLand,
          VehicleMode::kMission, VehicleMode::kStabilized, VehicleMode::kOther}) {
      const Cockpit c = after_outage(mode, "ANOTHER", hovers);
      EXPECT_TRUE(c.desk.sent.empty()) << name_of(mode);
      EXPECT_TRUE(c.director.control().is_taken()) << name_of(mode);
      EXPECT_FALSE(c.director.takes_setpoints()) << name_of(mode);
    }
}

TEST(FlightDirector, GoesOnAfterAnOutageInWhichNothingChanged) {
  const Cockpit c = after_outage(VehicleMode::kGuided, "GUIDED");
  EXPECT_TRUE(c.director.takes_setpoints());
  EXPECT_TRUE(c.director.reached());
}

TEST(FlightDirector, TakesUpAgainWhatIsHandedBackByACommand) {
  Cockpit c = after_outage(VehicleMode::kReturn, "RTL");
  ASSERT_TRUE(c.director.hand_back(c.events).ok());
  c.run(1);
  EXPECT_EQ(c.count<ModeRequest>(), 1u);
  EXPECT_TRUE(c.director.takes_setpoints());
  EXPECT_EQ(c.reported(EventKind::kHandedBack), 1u);
  EXPECT_FALSE(c.director.hand_back(c.events).ok()) << "its agent has it";
  c.set(VehicleMode::kGuided, "GUIDED", true, false);
  c.run(1);
  EXPECT_TRUE(c.director.reached());
}

TEST(FlightDirector, DoesNotTakeItFromSticksByACommand) {
  Cockpit c = guided();
  c.set(VehicleMode::kStabilized, "FBWA", true, false);
  c.run(1);
  EXPECT_FALSE(c.director.hand_back(c.events).ok());
  EXPECT_TRUE(c.director.control().is_taken());
}

TEST(FlightDirector, AsksForNothingInTheAirWhereItIsNotKnown) {
  Cockpit c = guided();
  c.desk.sent.clear();
  c.knows_position = false;
  c.director.land({Vec2(0, 0), 0, {}});
  c.run(10);
  EXPECT_TRUE(c.desk.sent.empty());
  c.knows_position = true;
  c.run(1);
  EXPECT_EQ(c.count<LandRequest>(), 1u);
}

TEST(FlightDirector, NeverTakesItFromAPilotWhoFliesAlready) {
  Cockpit c;
  c.set(VehicleMode::kManual, "MANUAL", true, false);
  c.director.fly();
  c.run(30);
  EXPECT_TRUE(c.desk.sent.empty());
  EXPECT_EQ(c.director.control().mode(), VehicleMode::kManual);
  EXPECT_TRUE(c.director.control().is_taken());
}

TEST(FlightDirector, LandsAndDisarms) {
  Cockpit c = guided();
  c.director.land({Vec2(0, 0), 0, {}});
  c.run(1);
  EXPECT_EQ(c.count<LandRequest>(), 1u);
  c.answer(Outcome::kAccepted);
  c.set(VehicleMode::kMission, "AUTO", true, false);
  c.run(60);
  EXPECT_EQ(c.count<LandRequest>(), 1u);
  EXPECT_FALSE(c.director.done());
  c.condition.on_ground = true;
  c.run(10);
  EXPECT_EQ(c.count<ArmRequest>(), 1u);
  c.condition.armed = false;
  c.run(1);
  EXPECT_TRUE(c.director.done());
}

}  // namespace
}  // namespace skein::mixed::flight_director_test
