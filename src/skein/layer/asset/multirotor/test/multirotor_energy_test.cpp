// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/asset/multirotor/momentum.h"
#include "skein/layer/asset/multirotor/multirotor_plant.h"

namespace skein::asset::multirotor_energy_test {
namespace {

Actuators hover_throttles(const MultirotorParameters& p, const VehicleState& s) {
  Actuators throttles;
  for (std::size_t k = 0; k < p.rotors.size(); ++k)
    throttles[k] = s.actuators[k] / p.fastest_rotor;
  return throttles;
}

TEST(InducedSpeed, SolvesItsEquation) {
  const double hover2 = 5.44 * 5.44;
  EXPECT_NEAR(induced_speed(hover2, 0, 0), 5.44, 1e-12);
  for (const double along : {0.0, 3.0, 6.0, 12.0, 20.0})
    for (const double climb : {-3.0, -1.0, 0.0, 2.0, 5.0}) {
      double low = 0, high = 50;  // by halving
      for (int i = 0; i < 100; ++i) {
        const double v = (low + high) / 2;
        const double through = climb + v;
        (v * v * (along * along + through * through) < hover2 * hover2 ? low : high) = v;
      }
      const double found = induced_speed(hover2, along * along, climb);
      EXPECT_NEAR(found, low, 0.02 * low) << along << ' ' << climb;
      EXPECT_GT(found, low - 1e-9);
    }
}

TEST(MultirotorPlant, HoverPowerIsAsByHand) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  // Drag torque times speed of four rotors at 520 rad/s, the efficiency, the electronics.
  const double speed = std::sqrt(p.mass * kGravity / (4 * p.thrust_factor));
  const double by_hand =
      4 * p.torque_factor * speed * speed * speed / p.efficiency + p.standing_power;
  EXPECT_NEAR(plant.trim(Vec3::Zero(), 0).power, by_hand, 1e-9 * by_hand);
  EXPECT_GT(by_hand, 180);
  EXPECT_LT(by_hand, 200);
  // Figure of merit: ideal power over shaft power.
  const double thrust = p.mass * kGravity / 4;
  const double disc = geo::kPi * p.rotor_radius * p.rotor_radius;
  const double ideal = thrust * std::sqrt(thrust / (2 * 1.225 * disc));
  EXPECT_NEAR(ideal / (p.torque_factor * speed * speed * speed), 0.6, 0.03);
}

TEST(MultirotorPlant, HoversForItsEndurance) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  VehicleState s = plant.start({});
  const double predicted = Battery(p.battery).endurance(s.energy);
  const Actuators throttles = hover_throttles(p, s);
  double seconds = 0;
  while (s.energy.charge > 0 && s.v_N.norm() < 0.1) {
    plant.step(s, throttles, {}, 0.01);
    s.w_NB_B.setZero();  // the attitude is not held here
    seconds += 0.01;
  }
  // It sinks when the battery can give hover power no more.
  EXPECT_NEAR(seconds, predicted, 5);
  EXPECT_GT(predicted, 20 * 60);
  EXPECT_LT(predicted, 25 * 60);
}

TEST(MultirotorPlant, PowerHasItsMinimumInForwardFlight) {
  const MultirotorPlant plant{MultirotorParameters{}};
  const double hover = plant.trim(Vec3::Zero(), 0).power;
  const double slow = plant.trim({6, 0, 0}, 0).power;
  const double fast = plant.trim({16, 0, 0}, 0).power;
  EXPECT_LT(slow, 0.95 * hover);
  EXPECT_GT(fast, 1.1 * slow);
}

TEST(MultirotorPlant, ClimbTakesAtLeastTheWorkAgainstGravity) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  const double hover = plant.trim(Vec3::Zero(), 0).power;
  const double climb = plant.trim({0, 0, -3}, 0).power;
  const double sink = plant.trim({0, 0, 2}, 0).power;
  const double work = p.mass * kGravity * 3 / p.efficiency;
  // Momentum theory: induced flow falls by about half the climb speed, so that more than
  // half the work remains; rotor drag along the axis comes on top.
  EXPECT_GT(climb - hover, 0.5 * work);
  EXPECT_LT(climb - hover, 1.5 * work);
  EXPECT_LT(sink, hover);
}

TEST(MultirotorPlant, AnEmptyBatteryStopsItsRotors) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  VehicleState s = plant.start({});
  const Actuators throttles = hover_throttles(p, s);
  s.faults.battery = true;
  for (int i = 0; i < 90; ++i) plant.step(s, throttles, {}, 0.01);
  EXPECT_EQ(s.actuators[0], 0);  // 520 exp(-0.9/0.04) is below 1e-6 rad/s
  EXPECT_EQ(s.energy.power, 0);
  EXPECT_EQ(s.energy.charge, 1);
  EXPECT_GT(s.v_N.z(), 2);
}

TEST(MultirotorPlant, AWeakBatterySlowsItsRotors) {
  MultirotorParameters p;
  p.battery.resistance = 0.2;
  const MultirotorPlant plant(p);
  VehicleState s = plant.start({});
  Actuators full;
  full.channel.fill(1);
  for (int i = 0; i < 100; ++i) {
    plant.step(s, full, {}, 0.01);
    s.v_N.setZero();  // on a test stand
  }
  EXPECT_LT(s.actuators[0], 0.99 * p.fastest_rotor);
  EXPECT_NEAR(s.energy.power, Battery(p.battery).max_power(s.energy.charge),
              0.01 * s.energy.power);
  EXPECT_NEAR(s.energy.voltage, p.battery.cutoff * 4, 0.05);
}

}  // namespace
}  // namespace skein::asset::multirotor_energy_test
