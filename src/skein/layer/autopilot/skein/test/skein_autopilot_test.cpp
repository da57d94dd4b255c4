// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/skein_autopilot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::autopilot::skein_autopilot_test {
namespace {

// A point in coordinated flight, fed back through the ideal navigation sensor.
class PointFlight {
 public:
  explicit PointFlight(const SkeinOptions& options = {}) {
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

TEST(SkeinAutopilot, FliesItsCommands) {
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
  const auto command =
      std::get<FlightCommand>(flight.autopilot().control(flight.now, 0.1));
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

TEST(SkeinAutopilot, ReportsWhenItsEstimatorFallsSilent) {
  PointFlight flight;
  flight.autopilot().command(course(0, 300));
  flight.fly(10);
  // No sample any more: time goes on, the estimate does not.
  for (int k = 0; k < 40; ++k)
    flight.autopilot().control(flight.now + Time::from_seconds(0.1 * k), 0.1);
  EXPECT_EQ(flight.autopilot().status().trigger, FailsafeTrigger::kGnss);
}

TEST(SkeinAutopilot, CountsOnWhenTheBatteryMonitorFallsSilent) {
  PointFlight flight;
  flight.autopilot().command(course(0, 300));
  double charge = 1;
  const auto report = [&] {
    PowerSample power;
    power.time = flight.now;
    power.charge = charge;
    flight.autopilot().sense(power);
  };
  for (int k = 0; k < 60; ++k) {
    report();
    flight.fly(1);
    charge -= 0.005;
  }
  flight.fly(100);
  EXPECT_NEAR(flight.autopilot().status().charge, 1 - 0.005 * 160, 0.03);
  EXPECT_EQ(flight.autopilot().status().trigger, FailsafeTrigger::kBattery);
  flight.fly(100);
  EXPECT_EQ(flight.autopilot().status().charge, 0) << "empty, not less";
}

TEST(SkeinAutopilot, WhatAFailsafeHasDoneIsNotTheMissionsEnd) {
  PointFlight flight;
  flight.autopilot().command(
      {FlyWaypoints{{{{0, 0}, 300}, {{900, 0}, 300}, {{900, 900}, 300}}, 100}, 300});
  flight.fly(60);
  flight.link = false;
  flight.fly(200);
  EXPECT_EQ(flight.autopilot().status().reaction, FailsafeReaction::kReturn);
  EXPECT_FALSE(flight.autopilot().status().done);
}

TEST(SkeinAutopilot, BeginsAnew) {
  PointFlight flight;
  flight.autopilot().command(course(1, 300));
  flight.fly(30);
  NavEstimate start;
  start.time = Time::from_seconds(500);
  start.p_N = {100, 200, -300};
  start.v_N = {20, 0, 0};
  flight.autopilot().begin(start, false);
  EXPECT_EQ(flight.autopilot().estimate().time, start.time);
  EXPECT_EQ(flight.autopilot().estimate().p_N, start.p_N);
  EXPECT_EQ(flight.autopilot().status().trigger, FailsafeTrigger::kNone);
}

TEST(SkeinAutopilot, KeepsHomeAndItsLastCommandWhenItComesBack) {
  PointFlight flight;
  flight.autopilot().command(course(1, 330));
  flight.fly(10);
  // Carried elsewhere while it was away.
  flight.now += Time::from_seconds(500);
  flight.p = {4000, 1000, -300};
  flight.heading = -1;
  flight.roll = flight.climb = 0;
  NavEstimate start;
  start.time = flight.now;
  start.p_N = flight.p;
  start.heading = flight.heading;
  flight.autopilot().begin(start, false);
  flight.sense();
  flight.fly(40);
  EXPECT_EQ(flight.autopilot().status().mode, FlightMode::kGuided);
  EXPECT_NEAR(flight.heading, 1, 0.02);
  EXPECT_NEAR(-flight.p.z(), 330, 1);

  flight.link = false;
  flight.fly(400);
  EXPECT_EQ(flight.autopilot().status().reaction, FailsafeReaction::kReturn);
  EXPECT_LT(geo::horizontal(flight.p).norm(), 300) << "home is where it first began";
}

TEST(SkeinAutopilot, FliesItsRouteFromTheBeginningWhenItComesBack) {
  PointFlight flight;
  flight.autopilot().command(
      {FlyWaypoints{{{{600, 0}, 300}, {{600, 600}, 300}, {{0, 600}, 300}}, 1}, 300});
  flight.fly(60);
  const double before = flight.autopilot().status().remaining;
  NavEstimate start;
  start.time = flight.now;
  start.p_N = flight.p;
  start.heading = flight.heading;
  flight.autopilot().begin(start, false);
  flight.sense();
  flight.fly(1);
  EXPECT_EQ(flight.autopilot().status().mode, FlightMode::kAuto);
  EXPECT_TRUE(flight.autopilot().status().follows);
  EXPECT_GT(flight.autopilot().status().remaining, before + 200);
}

TEST(SkeinAutopilot, ACommandBeforeTheFirstStepOutlivesABeginning) {
  PointFlight flight;
  flight.autopilot().command(course(1, 330));
  NavEstimate start;
  start.p_N = flight.p;
  flight.autopilot().begin(start, false);
  flight.sense();
  flight.fly(40);
  EXPECT_NEAR(flight.heading, 1, 0.02);
}

// Fleets are larger than the caches, so that a step costs what it touches: options
// belong in SkeinSetup. Sizes are as they were measured, with room for some numbers more.
TEST(SkeinAutopilot, KeepsLittleForEachAircraft) {
  constexpr std::size_t kRoom = 256;
  EXPECT_LE(sizeof(FlightEstimator), 5200 + kRoom);
  EXPECT_LE(sizeof(ModeLogic), 176 + kRoom);
  EXPECT_LE(sizeof(FixedWingController), 1792 + kRoom);
  EXPECT_LE(sizeof(MultirotorController), 1520 + kRoom);
  EXPECT_LE(sizeof(SkeinAutopilot), 8192 + kRoom);
}

// Uses 0.05 % of the charge a second, from a bit more than critical until 1 % is left.
void run_dry(PointFlight& flight) {
  for (double charge = 0.09; charge > 0.01; charge -= 0.0005) {
    PowerSample power;
    power.time = flight.now;
    power.charge = charge;
    flight.autopilot().sense(power);
    flight.fly(1);
  }
}

TEST(SkeinAutopilot, ALandingAtHomeIsNotGivenUpForTheChargeThatItTakes) {
  PointFlight flight;
  flight.fly(1);
  // At home, 60 s of landing take 3 %: less than there is when the battery becomes
  // critical, more than there is at the end.
  run_dry(flight);
  EXPECT_EQ(flight.autopilot().status().trigger, FailsafeTrigger::kBattery);
  EXPECT_EQ(flight.autopilot().status().reaction, FailsafeReaction::kLand);
  EXPECT_GE(flight.autopilot().status().reserve, 0);
}

TEST(SkeinAutopilot, ACriticalBatteryFarFromHomeBringsItDownWhereItIs) {
  PointFlight flight;
  flight.autopilot().command(course(0, 300));
  flight.fly(300);  // 6 km: 300 s back take 15 %
  run_dry(flight);
  EXPECT_EQ(flight.autopilot().status().trigger, FailsafeTrigger::kBattery);
  EXPECT_EQ(flight.autopilot().status().reaction, FailsafeReaction::kDescend);
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
  EXPECT_EQ(flight.autopilot().status().reaction, FailsafeReaction::kLand);
  EXPECT_EQ(flight.autopilot().status().charge, 0.14);
}

// A fixed wing that is carried around a square, with wings level, whatever its autopilot
// does.
struct CarriedWing {
  explicit CarriedWing(std::vector<LapGains> laps) {
    FixedWingAirframe frame;
    frame.mass = 0.9;
    frame.slowest = 11;
    frame.cruise = 15;
    frame.fastest = 18;
    frame.bank_limit = 0.7;
    frame.pitch_up = 0.4;
    frame.pitch_down = -0.4;
    frame.climb_rate = frame.sink_rate = 2;
    frame.trim_throttle = 0.5;
    SkeinOptions options;
    options.wing_guidance.rounds_corners = false;
    options.lap_gains = std::move(laps);
    NavEstimate start;
    start.p_N = {0, 0, -100};
    start.v_N = {15, 0, 0};
    autopilot = std::make_unique<SkeinAutopilot>(
        std::make_shared<SkeinSetup>(options, FlightLimits{15, 40, 2, 11, 18, 2}, frame),
        start, false);
    carry({0, 0}, 0);
    FlyWaypoints square;
    for (const Vec2& point : {Vec2(300, 0), Vec2(300, 300), Vec2(0, 300), Vec2(0, 0)})
      square.points.push_back({point, 100});
    square.laps = 3;
    autopilot->command({square, 100, {}});
  }

  void carry(const Vec2& at, double course) {
    TruthSample truth;
    truth.time = now;
    const Vec2 v = 15 * geo::unit(course);
    truth.p_N = {at.x(), at.y(), -100};
    truth.v_N = {v.x(), v.y(), 0};
    truth.q_NB = geo::from_euler({0, 0.05, course});
    autopilot->sense(truth);
    autopilot->sense(LinkSample{now});
    commanded = std::get<Actuators>(autopilot->control(now, 0.05));
    now += Time::from_seconds(0.05);
  }

  // One leg, `off` metres to the right of it, and a step beyond its end.
  void leg(int k, double off) {
    const double course = geo::kPi / 2 * k;
    const Vec2 corners[] = {{0, 0}, {300, 0}, {300, 300}, {0, 300}};
    for (double along = 0; along < 301; along += 0.75) {
      carry(corners[k % 4] + along * geo::unit(course) +
                off * geo::unit(course + geo::kPi / 2),
            course);
      if (along == 225) aileron = commanded[channel::kAileron];
    }
  }

  std::unique_ptr<SkeinAutopilot> autopilot;
  Actuators commanded;
  double aileron = 0;  // late on the last leg
  Time now;
};

LapGains roll_gains(double gain) {
  LapGains lap;
  lap.wing.roll_gain = gain;
  lap.wing.roll_rate_integral = 0;  // so that only the gains count, not the past
  return lap;
}

TEST(SkeinAutopilot, FliesEachLapWithItsOwnGains) {
  CarriedWing changing({roll_gains(2), roll_gains(5)}), stiff({roll_gains(5)});
  for (int k = 0; k < 12; ++k) {
    changing.leg(k, 3);
    stiff.leg(k, 3);
    // The bank demanded is the same all the time: 3 m off a straight line.
    EXPECT_EQ(changing.autopilot->status().lap, (k + 1) / 4) << k;
    EXPECT_LT(stiff.aileron, 0) << "back to the left";
    const double share = changing.aileron / stiff.aileron;
    // The aileron is the gain times the roll error, and the rate is nothing.
    EXPECT_NEAR(share, k < 4 ? 2.0 / 5 : 1, 0.02) << k;
  }
  EXPECT_TRUE(changing.autopilot->status().done);
}

TEST(SkeinAutopilot, NothingJumpsWhenGainsChange) {
  LapGains other = roll_gains(5);
  other.wing.height_gain *= 2;
  other.lateral.l2.time *= 2;
  CarriedWing changing({roll_gains(4), other});
  for (int k = 0; k < 3; ++k) changing.leg(k, 0);
  const double course = 3 * geo::kPi / 2;
  for (double along = 0; along < 290; along += 0.75)
    changing.carry(Vec2(0, 300) + along * geo::unit(course), course);
  // On the line at the right height and speed there is nothing that a gain multiplies.
  const Actuators before = changing.commanded;
  for (double along = 290; along < 305; along += 0.75) {
    changing.carry(Vec2(0, 300) + along * geo::unit(course), course);
    if (changing.autopilot->status().lap == 1) break;
  }
  ASSERT_EQ(changing.autopilot->status().lap, 1);
  changing.carry({0, 0}, 0);  // the first step with the other gains
  for (const std::size_t k : {channel::kElevator, channel::kThrottle})
    EXPECT_NEAR(changing.commanded[k], before[k], 0.05) << k;
}

TEST(SkeinAutopilot, ReturnsByTheRouteThatWasSet) {
  PointFlight flight;
  flight.autopilot().command(course(0, 300));
  flight.fly(60);
  flight.autopilot().set_return({{{900, 900}, {0, 900}}, 100});
  flight.fly(1);
  EXPECT_NEAR(geo::wrap_pi(flight.heading), 0, 0.02);  // for returns only
  flight.link = false;
  double nearest_corner = 1e9, nearest_home = 1e9;
  for (int k = 0; k < 200; ++k) {
    flight.fly(1);
    const Vec2 p = geo::horizontal(flight.p);
    nearest_corner = std::min(nearest_corner, (p - Vec2(900, 900)).norm());
    nearest_home = std::min(nearest_home, p.norm());
  }
  EXPECT_LT(nearest_corner, 130);
  EXPECT_GT(nearest_home, 700);
  EXPECT_LT((geo::horizontal(flight.p) - Vec2(0, 900)).norm(), 120);
  // Another place while it is there, then home again.
  flight.autopilot().set_return({{{500, 0}}, 100});
  flight.fly(100);
  EXPECT_LT((geo::horizontal(flight.p) - Vec2(500, 0)).norm(), 120);
  flight.autopilot().set_return({});
  flight.fly(60);
  EXPECT_LT(geo::horizontal(flight.p).norm(), 120);
}

TEST(SkeinAutopilot, LandsWhereReturnsLeadAndKeepsThatWhenItBeginsAnew) {
  PointFlight flight;
  flight.autopilot().command({Return{}, 300, {}});
  flight.autopilot().set_return({{{600, 600}}, 250});
  flight.autopilot().begin(flight.autopilot().estimate(), false);
  flight.sense();
  flight.fly(90);
  EXPECT_LT((geo::horizontal(flight.p) - Vec2(600, 600)).norm(), 120);
  run_dry(flight);
  EXPECT_EQ(flight.autopilot().status().reaction, FailsafeReaction::kLand);
  flight.fly(60);
  EXPECT_LT((geo::horizontal(flight.p) - Vec2(600, 600)).norm(), 400);
  EXPECT_LT(-flight.p.z(), 285);
}

TEST(SkeinAutopilot, CountsTheWholeRouteOfAReturn) {
  const auto reserve = [](const ReturnRoute& route) {
    PointFlight flight;
    flight.autopilot().set_return(route);
    for (int k = 0; k < 100; ++k) {
      PowerSample power;
      power.time = flight.now;
      power.charge = 0.9 - 0.0005 * k;
      flight.autopilot().sense(power);
      flight.fly(1);
    }
    return flight.autopilot().status().reserve;
  };
  // 0.05 % a second: 2 km of detour at 20 m/s are 5 %.
  const double straight = reserve({{{0, 0}}, 300}),
               around = reserve({{{1000, 0}, {0, 0}}, 300});
  EXPECT_NEAR(straight - around, 0.05, 0.008);
}

}  // namespace
}  // namespace skein::autopilot::skein_autopilot_test
