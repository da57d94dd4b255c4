#include "layer/autopilot/skein/skein_autopilot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::autopilot {
namespace {

// A point in coordinated flight, fed back through the ideal navigation sensor.
class PointFlight {
 public:
  explicit PointFlight(SkeinOptions options = {}) {
    NavEstimate start;
    start.p_N = p;
    start.v_N = {20, 0, 0};
    autopilot_ = std::make_unique<SkeinAutopilot>(
        std::make_shared<SkeinSetup>(options, FlightLimits{}, SelfStabilised{}), start,
        false);
    sense();
  }

  SkeinAutopilot& autopilot() { return *autopilot_; }

  void fly(double seconds) {
    for (const Time end = now + Time::from_seconds(seconds); now < end;) {
      const auto command = std::get<FlightCommand>(autopilot_->control(now, 0.1));
      roll = command.roll;
      climb = command.climb_rate;
      heading += kGravity * std::tan(roll) / 20 * 0.1;
      p += 0.1 * Vec3(20 * std::cos(heading), 20 * std::sin(heading), -climb);
      now += Time::from_seconds(0.1);
      sense();
    }
  }

  void sense() {
    TruthSample truth;
    truth.time = now;
    truth.p_N = p;
    truth.v_N = {20 * std::cos(heading), 20 * std::sin(heading), -climb};
    truth.q_NB = geo::from_euler({roll, 0, heading});
    autopilot_->sense(truth);
    if (link) autopilot_->sense(LinkSample{now});
    if (pilot) {
      pilot->time = now;
      autopilot_->sense(*pilot);
    }
  }

  Vec3 p = {0, 0, -300};
  double heading = 0, roll = 0, climb = 0;
  Time now;
  bool link = true;
  std::optional<PilotInput> pilot;

 private:
  std::unique_ptr<SkeinAutopilot> autopilot_;
};

AutopilotCommand course(double angle, double altitude) {
  return {HoldCourse{angle}, altitude};
}

TEST(SkeinAutopilot, FliesWhatItIsTold) {
  PointFlight flight;
  flight.autopilot().command(course(1, 330));
  flight.fly(40);
  EXPECT_NEAR(flight.heading, 1, 0.02);
  EXPECT_NEAR(-flight.p.z(), 330, 1);
  EXPECT_EQ(flight.autopilot().status().mode, FlightMode::kGuided);
  EXPECT_EQ(flight.autopilot().estimate().time, flight.now);
}

TEST(SkeinAutopilot, CirclesWhereItIsBeforeTheFirstCommand) {
  PointFlight flight;
  flight.fly(60);
  EXPECT_LT(geo::horizontal(flight.p).norm(), 300);
}

TEST(SkeinAutopilot, RefusesWhatCannotBeFlownAndGoesOn) {
  PointFlight flight;
  flight.autopilot().command(course(1, 300));
  flight.fly(20);
  flight.autopilot().command({FollowPath{{{{0, 0}, 0, 100, 1.0}}}, 300});  // 1 m radius
  flight.fly(5);
  EXPECT_EQ(flight.autopilot().status().refusals, 1);
  EXPECT_FALSE(flight.autopilot().status().refused.empty());
  EXPECT_NEAR(flight.heading, 1, 0.02);
}

TEST(SkeinAutopilot, GoesHomeWhenTheLinkIsLostAndResumesWhenItIsBack) {
  PointFlight flight;
  flight.autopilot().command(course(0, 300));
  flight.fly(60);
  flight.link = false;
  flight.fly(8);
  EXPECT_EQ(flight.autopilot().status().trigger, FailsafeTrigger::kLink);
  EXPECT_EQ(flight.autopilot().status().reaction, FailsafeReaction::kReturn);
  flight.fly(120);
  EXPECT_LT(geo::horizontal(flight.p).norm(), 200);
  flight.link = true;
  flight.fly(30);
  EXPECT_EQ(flight.autopilot().status().trigger, FailsafeTrigger::kNone);
  EXPECT_NEAR(geo::wrap_pi(flight.heading), 0, 0.02);
}

TEST(SkeinAutopilot, ThePilotFliesWithinOneStepAndHandsBack) {
  PointFlight flight;
  flight.autopilot().command(course(0, 300));
  flight.fly(10);
  PilotInput sticks;
  sticks.takes_over = true;
  sticks.roll = 1;
  flight.pilot = sticks;
  flight.sense();
  const auto command = std::get<FlightCommand>(flight.autopilot().control(flight.now, 0.1));
  EXPECT_NEAR(command.roll, std::atan(400 / (kGravity * 60)), 1e-9);
  flight.fly(5);
  EXPECT_EQ(flight.autopilot().status().mode, FlightMode::kStabilized);
  flight.pilot->takes_over = false;
  flight.fly(40);
  EXPECT_EQ(flight.autopilot().status().mode, FlightMode::kGuided);
  EXPECT_NEAR(geo::wrap_pi(flight.heading), 0, 0.02);
}

TEST(SkeinAutopilot, TurnsBackAtTheFence) {
  SkeinOptions options;
  options.fence.area = {{{-500, -500}, {500, -500}, {500, 500}, {-500, 500}}};
  PointFlight flight(options);
  flight.autopilot().command(course(0, 300));
  flight.fly(40);
  EXPECT_EQ(flight.autopilot().status().trigger, FailsafeTrigger::kGeofence);
  flight.fly(60);
  EXPECT_LT(geo::horizontal(flight.p).norm(), 300);
}

TEST(SkeinAutopilot, AnEmptyBatteryBringsItHome) {
  PointFlight flight;
  flight.autopilot().command(course(0, 300));
  flight.fly(30);
  for (int k = 0; k < 10; ++k) {
    PowerSample power;
    power.time = flight.now;
    power.charge = 0.14;
    flight.autopilot().sense(power);
    flight.fly(1);
  }
  EXPECT_EQ(flight.autopilot().status().trigger, FailsafeTrigger::kBattery);
  EXPECT_EQ(flight.autopilot().status().reaction, FailsafeReaction::kReturn);
  EXPECT_EQ(flight.autopilot().status().charge, 0.14);
}

}  // namespace
}  // namespace skein::autopilot
