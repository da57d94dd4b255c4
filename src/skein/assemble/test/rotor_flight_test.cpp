// SPDX-License-Identifier: Apache-2.0
// The control loops close over the real plants, in the wind: true state, no estimator.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "skein/assemble/test/control_flight.h"
#include "skein/layer/asset/multirotor/multirotor_plant.h"
#include "skein/layer/autopilot/control/multirotor_control.h"

namespace skein::rotor_flight_test {
namespace {

using autopilot::MultirotorControl;
using autopilot::MultirotorDemand;

TEST(MultirotorFlight, HoversInWindAndLightTurbulence) {
  const asset::MultirotorPlant plant(asset::MultirotorParameters{});
  const auto airframe = std::get<MultirotorAirframe>(plant.airframe());
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Flight flight(plant, Vec3(0, 6, 0), kLight, 0.5, seed);
    MultirotorControl control(airframe, {});
    MultirotorDemand demand;
    demand.altitude_msl = kHeight;
    double max = 0;
    for (double t = 0; t < 60; t += kStep) {
      flight.step(control.control(demand, flight.nav(), kStep));
      max = std::max(max, (flight.state.p_N - Vec3(0, 0, -kHeight)).norm());
    }
    EXPECT_LT(max, 1) << seed;  // the goal
  }
}

TEST(MultirotorFlight, SurvivesSevereTurbulenceWithWrongParameters) {
  const auto airframe = std::get<MultirotorAirframe>(
      asset::MultirotorPlant(asset::MultirotorParameters{}).airframe());
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    RandomStream random(seed, 0, Purpose::kTest);
    asset::MultirotorParameters p;
    do {
      p = {};
      for (double* x : {&p.mass, &p.inertia.xx, &p.inertia.yy, &p.inertia.zz,
                        &p.thrust_factor, &p.torque_factor, &p.motor_lag, &p.rotor_drag})
        *x *= random.uniform(0.9, 1.1);
    } while (!asset::errors(p).empty());
    const asset::MultirotorPlant plant(p);
    Flight flight(plant, Vec3(8, 0, 0), kSevere, 0.5, seed);
    MultirotorControl control(airframe, {});
    MultirotorDemand demand;
    demand.altitude_msl = kHeight;
    for (double t = 0; t < 60; t += kStep) {
      flight.step(control.control(demand, flight.nav(), kStep));
      ASSERT_GT(geo::down_in_body(flight.state.q_NB).z(), 0) << seed << ' ' << t;
      // Gusts beyond the airspeed that the tilt limit allows carry it away for a while.
      ASSERT_LT((flight.state.p_N - Vec3(0, 0, -kHeight)).norm(), 30) << seed << ' ' << t;
    }
  }
}

TEST(MultirotorFlight, StepsDoNotOvershoot) {
  const asset::MultirotorPlant plant(asset::MultirotorParameters{});
  Flight flight(plant, Vec3::Zero(), 0, 0.5, 0);
  MultirotorControl control(std::get<MultirotorAirframe>(plant.airframe()), {});
  MultirotorDemand demand;
  demand.position = Vec2(10, 0);
  demand.altitude_msl = kHeight + 10;
  demand.heading = 3;
  double beyond = 0;
  for (double t = 0; t < 20; t += kStep) {
    flight.step(control.control(demand, flight.nav(), kStep));
    beyond = std::max({beyond, flight.state.p_N.x(), -flight.state.p_N.z() - kHeight});
  }
  EXPECT_LT(beyond, 10.5);
  EXPECT_LT((flight.state.p_N - Vec3(10, 0, -kHeight - 10)).norm(), 0.1);
  EXPECT_NEAR(geo::yaw(flight.state.q_NB), 3, 0.02);
}

TEST(MultirotorFlight, SixRotorsFlyOnWithOneStanding) {
  asset::MultirotorParameters p;
  p.mass = 2.2;
  p.rotors.clear();
  for (int k = 0; k < 6; ++k)
    p.rotors.push_back(
        {0.3 * geo::unit(geo::kPi / 6 * (2 * k + 1)), k % 2 == 0 ? 1.0 : -1.0});
  const asset::MultirotorPlant plant(p);
  for (unsigned dead = 0; dead < 6; ++dead) {
    Flight flight(plant, Vec3(6, 0, 0), kLight, 0.6, dead);
    MultirotorControl control(std::get<MultirotorAirframe>(plant.airframe()), {});
    MultirotorDemand demand;
    demand.altitude_msl = kHeight;
    double max = 0;
    for (double t = 0; t < 40; t += kStep) {
      if (t > 10) flight.state.faults.dead = static_cast<std::uint8_t>(1u << dead);
      if (t > 10.3) control.set_standing(static_cast<std::uint8_t>(1u << dead));
      flight.step(control.control(demand, flight.nav(), kStep));
      max = std::max(max, (flight.state.p_N - Vec3(0, 0, -kHeight)).norm());
    }
    EXPECT_LT(max, 3) << dead;
    EXPECT_LT((flight.state.p_N - Vec3(0, 0, -kHeight)).norm(), 1) << dead;
  }
}

TEST(MultirotorFlight, FourRotorsFlyOnSpinningWithOneStanding) {
  const asset::MultirotorPlant plant(asset::MultirotorParameters{});
  for (unsigned dead = 0; dead < 4; ++dead) {
    Flight flight(plant, Vec3(6, 0, 0), kLight, 0.5, dead);
    MultirotorControl control(std::get<MultirotorAirframe>(plant.airframe()), {});
    MultirotorDemand demand;
    demand.altitude_msl = kHeight;
    double lowest = kHeight;
    for (double t = 0; t < 50; t += kStep) {
      if (t > 10) flight.state.faults.dead = static_cast<std::uint8_t>(1u << dead);
      if (t > 10.3) control.set_standing(static_cast<std::uint8_t>(1u << dead));
      flight.step(control.control(demand, flight.nav(), kStep));
      lowest = std::min(lowest, -flight.state.p_N.z());
      if (t > 40) {
        // Steady again; measured 1.3 m.
        ASSERT_LT((flight.state.p_N - Vec3(0, 0, -kHeight)).norm(), 3)
            << dead << ' ' << t;
        ASSERT_GT(geo::down_in_body(flight.state.q_NB).z(), 0.8) << dead << ' ' << t;
      }
    }
    // It falls while it tumbles and gathers spin: measured 17 m.
    EXPECT_GT(lowest, kHeight - 35) << dead;
    EXPECT_GT(std::abs(flight.state.w_NB_B.z()), 5) << dead;
  }
}

}  // namespace
}  // namespace skein::rotor_flight_test
