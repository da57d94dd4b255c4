// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/layer/asset/fixed_wing/test/aircraft.h"
#include "skein/layer/asset/fixed_wing/trim.h"

// Take-off and landing of whole aircraft: what flight and ground make together.

namespace skein::asset::ground_run_test {
namespace {

constexpr double kStep = 0.01;
constexpr double kGround = 300;

class GroundRun {
 public:
  explicit GroundRun(const FixedWingParameters& parameters)
      : parameters_(parameters), plant_(parameters) {}

  VehicleState standing() const {
    return plant_.start({{0, 0, -kGround}, 0.5, Vec3::Zero(), true});
  }

  // Gliding or flying straight, `height` above the ground, at an airspeed and sink rate.
  VehicleState approaching(double airspeed, double sink, double height) const {
    const TrimResult found =
        find_trim(plant_.model(), {airspeed, -std::asin(sink / airspeed), 0, kGround});
    EXPECT_TRUE(found.found()) << reason(plant_.model(), found);
    VehicleState s = plant_.start({});
    set_motion(s,
               trimmed_motion(found.trim, {0, 0, -kGround - height}, 0.5, Vec3::Zero()));
    s.actuators[channel::kElevator] = found.trim.surfaces.elevator;
    s.actuators[channel::kAileron] = found.trim.surfaces.aileron;
    s.actuators[channel::kRudder] = found.trim.surfaces.rudder;
    s.actuators[channel::kThrottle] = found.trim.spin;
    held_ = Actuators{};
    held_[channel::kElevator] =
        found.trim.surfaces.elevator / parameters_.servos.elevator_max;
    held_[channel::kAileron] =
        found.trim.surfaces.aileron / parameters_.servos.aileron_max;
    held_[channel::kRudder] = found.trim.surfaces.rudder / parameters_.servos.rudder_max;
    held_[channel::kThrottle] = found.trim.throttle;
    return s;
  }

  // As the simulation does it.
  Contact step(VehicleState& s, const Actuators& actuators) const {
    plant_.step(s, actuators, {}, kStep);
    return -s.p_N.z() < kGround ? plant_.touch(s, kGround, kStep) : Contact::kRests;
  }

  const FixedWingParameters& parameters() const { return parameters_; }
  const Actuators& held() const { return held_; }  // of the last approach

 private:
  FixedWingParameters parameters_;
  FixedWingPlant plant_;
  mutable Actuators held_;
};

double height(const VehicleState& s) {
  return -s.p_N.z() - kGround;
}

TEST(GroundRun, StandsStillWithIdleMotor) {
  for (const auto& parameters : {aerosonde(), glider(), light_sport()}) {
    const GroundRun run(parameters);
    VehicleState s = run.standing();
    for (int i = 0; i < 500; ++i) ASSERT_EQ(run.step(s, {}), Contact::kRests);
    EXPECT_TRUE(s.on_ground);
    EXPECT_EQ(s.v_N, Vec3(0, 0, 0));
    EXPECT_EQ(height(s), 0);
    EXPECT_NEAR(geo::yaw(s.q_NB), 0.5, 1e-6);
    EXPECT_NEAR(geo::to_euler(s.q_NB).pitch, parameters.ground.rest_pitch, 1e-3);
  }
}

// Full throttle, elevator up from the slowest airspeed on, wings level by aileron, until
// 5 m up.
TEST(GroundRun, TakesOffByRollingAndElevator) {
  for (const auto& parameters : {aerosonde(), glider(), light_sport()}) {
    const GroundRun run(parameters);
    VehicleState s = run.standing();
    double rolled = 0, lift_off = 0;
    for (int i = 0; i < 6000 && height(s) < 5; ++i) {
      const geo::Euler attitude = geo::to_euler(s.q_NB);
      Actuators a;
      a[channel::kThrottle] = 1;
      a[channel::kAileron] = -2 * attitude.roll - 0.5 * s.w_NB_B.x();
      a[channel::kElevator] = s.airspeed < parameters.envelope.slowest
                                  ? 0
                                  : -8 * (0.15 - attitude.pitch) + s.w_NB_B.y();
      ASSERT_EQ(run.step(s, a), Contact::kRests) << parameters.mass << ' ' << i;
      if (s.on_ground) {
        rolled = geo::horizontal(s.p_N).norm();
        lift_off = s.airspeed;
      }
    }
    EXPECT_GE(height(s), 5) << parameters.mass;
    EXPECT_FALSE(s.on_ground);
    EXPECT_GT(rolled, 3) << parameters.mass;
    EXPECT_GT(lift_off, 0.7 * parameters.envelope.slowest) << parameters.mass;
    EXPECT_LT(lift_off, 1.3 * parameters.envelope.slowest) << parameters.mass;
    // It kept its direction: nothing pushed it aside.
    EXPECT_NEAR(geo::bearing(geo::horizontal(s.p_N)), 0.5, 0.1) << parameters.mass;
  }
}

TEST(GroundRun, TouchesDownSlidesAndStops) {
  for (const auto& parameters : {aerosonde(), glider(), light_sport()}) {
    const GroundRun run(parameters);
    VehicleState s = run.approaching(parameters.envelope.slowest, 1, 1);
    Actuators a = run.held();
    double touch = 0;
    int bounced = 0;
    bool was_down = false;
    for (int i = 0; i < 20000 && !(s.on_ground && s.v_N.norm() == 0); ++i) {
      ASSERT_EQ(run.step(s, a), Contact::kRests) << parameters.mass << ' ' << i;
      if (s.on_ground && !was_down) {
        if (touch == 0) touch = s.airspeed;
        ++bounced;
        a[channel::kThrottle] = 0;
        a[channel::kElevator] = 0.2;  // nose down, to stay
      }
      was_down = s.on_ground;
    }
    EXPECT_TRUE(s.on_ground) << parameters.mass;
    EXPECT_EQ(s.v_N, Vec3(0, 0, 0)) << parameters.mass;
    EXPECT_NEAR(touch, parameters.envelope.slowest, 2) << parameters.mass;
    // A wing that still carries nearly all the weight skims the ground for a while.
    EXPECT_LT(bounced, 50) << parameters.mass;
    EXPECT_NEAR(geo::to_euler(s.q_NB).roll, 0, 0.01) << parameters.mass;
    EXPECT_NEAR(geo::to_euler(s.q_NB).pitch, parameters.ground.rest_pitch, 0.01)
        << parameters.mass;
  }
}

// From 15 m/s along the heading, on its wheels: distance, and turn, until it stands.
struct Stop {
  double distance = 0, turn = 0;
};
Stop stop(const GroundRun& run, const Actuators& actuators, std::uint8_t dead = 0) {
  VehicleState s = run.standing();
  s.v_N.head<2>() = 15 * geo::unit(0.5);
  s.faults.dead = dead;
  const Vec3 from = s.p_N;
  Stop out;
  for (int i = 0; i < 20000 && geo::horizontal(s.v_N).norm() > 0; ++i) {
    EXPECT_EQ(run.step(s, actuators), Contact::kRests);
    out.turn += s.w_NB_B.z() * kStep;
  }
  out.distance = (s.p_N - from).norm();
  return out;
}

TEST(GroundRun, BrakesStopIt) {
  const GroundRun run(light_sport());
  Actuators braking;
  braking[channel::kBrake] = 1;
  const double rolls = stop(run, {}).distance, brakes = stop(run, braking).distance;
  // Friction alone; drag, and lift that takes weight off the wheels, make a tenth.
  const double friction = run.parameters().ground.friction_along;
  const double all = friction + run.parameters().ground.brake_friction;
  EXPECT_NEAR(brakes, 15 * 15 / (2 * kGravity * all), 0.1 * brakes);
  EXPECT_GT(rolls, 4 * brakes);
  EXPECT_NEAR(stop(run, braking, 1u << channel::kBrake).distance, rolls, 1e-9)
      << "they fail";
  const GroundRun belly((glider()));
  EXPECT_NEAR(stop(belly, braking).distance, stop(belly, {}).distance, 1e-9)
      << "it has none";
}

TEST(GroundRun, WheelsSteerWithTheRudder) {
  for (const double rudder : {-0.2, 0.2}) {
    const GroundRun run(light_sport());
    Actuators a;
    a[channel::kBrake] = 0.3;
    a[channel::kRudder] = rudder;
    const Stop stopped = stop(run, a);
    // Turn per distance times distance; where the wheels slip it is less.
    const double asked = -rudder * run.parameters().ground.steering * stopped.distance;
    EXPECT_GT(stopped.turn / asked, 0.7);
    EXPECT_LT(stopped.turn / asked, 1.3);
  }
}

TEST(GroundRun, FlyingIntoTheGroundBreaksIt) {
  const GroundRun run(light_sport());
  VehicleState s = run.approaching(40, 2, 50);
  Actuators a = run.held();
  a[channel::kElevator] = 1;  // nose down
  Contact contact = Contact::kRests;
  for (int i = 0; i < 3000 && contact == Contact::kRests; ++i) contact = run.step(s, a);
  EXPECT_EQ(contact, Contact::kCrash);
}

}  // namespace
}  // namespace skein::asset::ground_run_test
