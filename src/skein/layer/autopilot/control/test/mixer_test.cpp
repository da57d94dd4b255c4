// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/mixer.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "skein/geo/vec.h"

namespace skein::autopilot::mixer_test {
namespace {

MultirotorAirframe ring(int rotors, double first) {
  MultirotorAirframe a;
  a.mass = 1.5;
  a.inertia = Vec3(0.02, 0.02, 0.04);
  for (int k = 0; k < rotors; ++k)
    a.rotors.push_back(
        {0.25 * geo::unit(first + 2 * geo::kPi * k / rotors), k % 2 == 0 ? 1.0 : -1.0});
  a.thrust_max = 8;
  a.torque_ratio = 0.016;
  a.tilt_limit = 0.6;
  a.fastest = 12;
  a.climb_rate = 4;
  a.sink_rate = 3;
  return a;
}

// What rotors at these throttles do, by the airframe's own words.
Wrench wrench_of(const MultirotorAirframe& a, const Actuators& u) {
  Wrench w;
  for (std::size_t k = 0; k < a.rotors.size(); ++k) {
    const double f = a.thrust_max * std::pow(u[k], a.thrust_exponent);
    const RotorPlace& r = a.rotors[k];
    w.thrust += f;
    w.torque += f * Vec3(-r.position.y(), r.position.x(), r.spin * a.torque_ratio);
  }
  return w;
}

constexpr double kRounding = 1e-9;  // of sums of a few newtons

TEST(Mixer, GivesTheWrenchWhereTheRotorsCan) {
  for (int rotors : {4, 5, 6, 8})
    for (double exponent : {1.0, 1.5, 2.0}) {
      MultirotorAirframe a = ring(rotors, 0.4);
      a.thrust_exponent = exponent;
      const double hover = 0.5 * a.thrust_max * rotors;
      const Wrench setpoint{hover, Vec3(0.3, -0.4, 0.03)};
      const Wrench got = wrench_of(a, Mixer(a, 0).mix(setpoint).throttle);
      EXPECT_NEAR(got.thrust, setpoint.thrust, kRounding) << rotors;
      EXPECT_LT((got.torque - setpoint.torque).norm(), kRounding) << rotors;
    }
}

TEST(Mixer, GivesUpYawBeforeThrustBeforeTilt) {
  const MultirotorAirframe a = ring(4, geo::kPi / 4);
  const Mixer mixer(a, 0);
  // Half thrust leaves room for all of the roll, but not for that much yaw.
  const Mix yaw = mixer.mix({16, Vec3(0.8, 0.5, 2)});
  const Wrench w = wrench_of(a, yaw.throttle);
  EXPECT_TRUE(yaw.yaw_limited);
  EXPECT_FALSE(yaw.tilt_limited);
  EXPECT_NEAR(w.torque.x(), 0.8, kRounding);
  EXPECT_NEAR(w.torque.y(), 0.5, kRounding);
  EXPECT_NEAR(w.thrust, 16, kRounding);
  EXPECT_GT(w.torque.z(), 0);
  // Full thrust leaves none: thrust falls until roll is whole.
  const Wrench roll = wrench_of(a, mixer.mix({32, Vec3(0.8, 0, 0)}).throttle);
  EXPECT_NEAR(roll.torque.x(), 0.8, kRounding);
  EXPECT_LT(roll.thrust, 31);
  // No thrust leaves none either: thrust rises.
  const Wrench low = wrench_of(a, mixer.mix({0, Vec3(0, 0.8, 0)}).throttle);
  EXPECT_NEAR(low.torque.y(), 0.8, kRounding);
  EXPECT_GT(low.thrust, 1);
  // More roll than there is: as much as there is, and no pitch instead.
  const Mix max = mixer.mix({16, Vec3(100, 0, 0)});
  const Wrench full = wrench_of(a, max.throttle);
  EXPECT_TRUE(max.tilt_limited);
  EXPECT_NEAR(full.torque.x(), 16 * 0.25 * std::sqrt(0.5), kRounding);
  EXPECT_NEAR(full.torque.y(), 0, kRounding);
}

TEST(Mixer, FliesASixRotorAirframeWithAnyOneStanding) {
  const MultirotorAirframe a = ring(6, 0);
  for (unsigned dead = 0; dead < 6; ++dead) {
    const Mixer mixer(a, static_cast<std::uint8_t>(1u << dead));
    const Wrench setpoint{a.mass * 9.8, Vec3(0.1, -0.1, 0)};
    const Mix mix = mixer.mix(setpoint);
    EXPECT_EQ(mix.throttle[dead], 0);
    const Wrench got = wrench_of(a, mix.throttle);
    EXPECT_NEAR(got.thrust, setpoint.thrust, kRounding);
    EXPECT_LT((got.torque - setpoint.torque).head<2>().norm(), kRounding);
    // Yaw is at the end of its range there: hover needs the opposite rotor to stand too.
    EXPECT_LT(std::abs(got.torque.z()), 0.02 * a.torque_ratio * a.mass * 9.8 + 0.03);
  }
}

TEST(Mixer, StaysInRangeAndKeepsTiltWhateverIsAsked) {
  EXPECT_TRUE(rc::check([] {
    const MultirotorAirframe a =
        ring(*rc::gen::inRange(3, 9), 0.001 * *rc::gen::inRange(0, 6000));
    const auto standing = static_cast<std::uint8_t>(*rc::gen::inRange(0, 256));
    const auto number = [] { return 0.001 * *rc::gen::inRange(-50000, 50000); };
    const Wrench setpoint{number(), Vec3(number(), number(), number())};
    const Mix mix = Mixer(a, standing).mix(setpoint);
    for (std::size_t k = 0; k < Actuators::kMaxChannels; ++k) {
      RC_ASSERT(mix.throttle[k] >= 0 && mix.throttle[k] <= 1);
      if ((standing >> k & 1u) != 0 || k >= a.rotors.size())
        RC_ASSERT(mix.throttle[k] == 0);
    }
  }));
}

}  // namespace
}  // namespace skein::autopilot::mixer_test
