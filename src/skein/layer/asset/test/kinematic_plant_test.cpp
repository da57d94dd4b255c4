// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/kinematic_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/base/random.h"

namespace skein::asset::kinematic_plant_test {
namespace {

// Of the default options: a turn of 60 m at 20 m/s.
const double kRollLimit = std::atan(20.0 * 20.0 / (9.80665 * 60));

VehicleState level_flight() {
  VehicleState state;
  state.airspeed = 20;
  state.v_N = {20, 0, 0};
  return state;
}

VehicleState fly(const KinematicPlant& plant, VehicleState state,
                 const FlightCommand& command, const Air& air, double seconds,
                 double dt) {
  const int steps = static_cast<int>(std::lround(seconds / dt));
  for (int i = 0; i < steps; ++i) plant.step(state, command, air, dt);
  return state;
}

VehicleState after(const KinematicPlant& plant, VehicleState state,
                   const FlightCommand& command, const Air& air, double dt) {
  plant.step(state, command, air, dt);
  return state;
}

double roll(const VehicleState& s) {
  return geo::to_euler(s.q_NB).roll;
}
double heading(const VehicleState& s) {
  return geo::yaw(s.q_NB);
}

TEST(KinematicPlant, FullBankIsTheStatedRadius) {
  KinematicOptions options;
  options.roll_rate = 0;
  const KinematicPlant plant(options);
  EXPECT_EQ(plant.limits().turn_radius, 60);
  const double half_turn = geo::kPi * 60 / 20;
  const VehicleState s =
      fly(plant, level_flight(), {10, 20, 0}, {}, half_turn, half_turn / 100);
  // Simpson's error at 0.1 s: V (omega dt)^4 / 2880 per second, 1e-7 m in all.
  EXPECT_NEAR(s.p_N.y(), 120, 1e-5);
  EXPECT_NEAR(s.p_N.x(), 0, 1e-5);
  EXPECT_NEAR(std::abs(heading(s)), geo::kPi, 1e-9);
  EXPECT_NEAR(roll(s), kRollLimit, 1e-12);
}

TEST(KinematicPlant, StepSizeDoesNotMatter) {
  const KinematicPlant plant{KinematicOptions{}};
  const Air air{{3, -5, 0}};
  VehicleState start = level_flight();
  start.airspeed = 18;
  const auto flight = [&](double dt) {
    VehicleState s = fly(plant, start, {0.5, 22, 2}, air, 20, dt);
    s = fly(plant, s, {-0.6, 20, -1}, air, 20, dt);
    return fly(plant, s, {0, 19, 0}, air, 20, dt);
  };
  const VehicleState fine = flight(0.001);
  for (const double dt : {0.01, 0.02, 0.1, 0.5, 1.0}) {
    const VehicleState s = flight(dt);
    EXPECT_LT((s.p_N - fine.p_N).norm(), 1e-4) << dt;  // the stated bound
    EXPECT_NEAR(heading(s), heading(fine), 1e-6) << dt;
    EXPECT_NEAR(s.airspeed, fine.airspeed, 1e-9) << dt;
  }
}

TEST(KinematicPlant, WindCarriesTheFlightAlong) {
  const KinematicPlant plant{KinematicOptions{}};
  const Air wind{{4, -7, 0.5}};
  const FlightCommand turn{0.4, 20, 0};
  const VehicleState still = fly(plant, level_flight(), turn, {}, 30, 0.05);
  const VehicleState blown = fly(plant, level_flight(), turn, wind, 30, 0.05);
  EXPECT_LT((blown.p_N - still.p_N - 30 * wind.wind_N).norm(), 1e-9);
  EXPECT_LT((blown.v_N - still.v_N - wind.wind_N).norm(), 1e-12);
}

TEST(KinematicPlant, KeepsItsBounds) {
  const KinematicPlant plant{KinematicOptions{}};
  VehicleState s = level_flight();
  s = after(plant, s, {-5, 100, 50}, {}, 0.2);
  EXPECT_NEAR(roll(s), -0.2, 1e-12);  // 1 rad/s
  EXPECT_NEAR(s.v_N.z(), -3, 1e-12);
  s = fly(plant, s, {-5, 100, 50}, {}, 60, 0.1);
  EXPECT_NEAR(roll(s), -kRollLimit, 1e-12);
  EXPECT_NEAR(s.airspeed, 25, 1e-9);
  EXPECT_NEAR(s.v_N.norm(), 25, 1e-6);
  s = fly(plant, s, {0, 0, 0}, {}, 60, 0.1);
  EXPECT_NEAR(s.airspeed, 15, 1e-9);
}

TEST(KinematicPlant, AirspeedAndRollFollowTheirLaws) {
  const KinematicPlant plant{KinematicOptions{}};
  const VehicleState s = after(plant, level_flight(), {0.3, 24, 0}, {}, 2.0);
  EXPECT_NEAR(s.airspeed, 24 - 4 * std::exp(-1.0), 1e-12);
  EXPECT_NEAR(roll(s), 0.3, 1e-12);
  const VehicleState half = after(plant, level_flight(), {0.3, 20, 0}, {}, 0.15);
  EXPECT_NEAR(roll(half), 0.15, 1e-12);
}

bool finite(const VehicleState& s) {
  return s.p_N.allFinite() && s.v_N.allFinite() && std::isfinite(s.airspeed) &&
         s.q_NB.coeffs().allFinite() && s.w_NB_B.allFinite();
}

TEST(KinematicPlant, StaysFiniteWhateverTheCommand) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  RandomStream random(1, 0, Purpose::kTest);
  const double special[] = {kNan, kInf, -kInf, 0, 1e-310, -1e300};
  const auto any = [&] {
    const auto pick = static_cast<std::size_t>(random.uniform(0, 9));
    return pick < 6 ? special[pick] : random.uniform(-30, 30);
  };
  for (int k = 0; k < 200; ++k) {
    KinematicOptions options;
    options.airspeed = std::pow(10, random.uniform(-1, 2.5));
    options.airspeed_range = random.uniform(0, 0.99);
    options.climb_rate = std::pow(10, random.uniform(-2, 2.3));  // above the airspeed too
    options.turn_radius = std::pow(10, random.uniform(-1, 4));
    options.roll_rate = k % 3 == 0 ? 0 : std::pow(10, random.uniform(-3, 2));
    options.airspeed_lag = k % 4 == 0 ? 0 : std::pow(10, random.uniform(-3, 2));
    const KinematicPlant plant(options);
    VehicleState s;
    s.airspeed = options.airspeed;
    for (int i = 0; i < 30; ++i) {
      s = after(plant, s, {any(), any(), any()}, {}, k % 2 == 0 ? 0.1 : 1.3);
      ASSERT_TRUE(finite(s)) << k << " " << i;
      // A climb counts against the airspeed.
      EXPECT_LE(s.v_N.norm(), s.airspeed * (1 + 1e-9)) << k << " " << i;
    }
  }
}

TEST(KinematicPlant, ClimbsStraightUpWhenTheClimbNeedsAllAirspeed) {
  KinematicOptions options;
  options.airspeed = 1;
  const KinematicPlant plant(options);  // climbs 3 m/s
  VehicleState s;
  s.airspeed = 1;
  s = after(plant, s, {0, 1, 3}, {}, 0.1);
  EXPECT_EQ(s.v_N, Vec3(0, 0, -1));
  // asin(1 - 1e-16) is off by 1e-8.
  EXPECT_NEAR(geo::to_euler(s.q_NB).pitch, geo::kPi / 2, 1e-7);
}

TEST(KinematicPlant, NoTimeChangesNothing) {
  const KinematicPlant plant{KinematicOptions{}};
  const VehicleState s = after(plant, level_flight(), {0.3, 24, 1}, {}, 0);
  EXPECT_EQ(s.p_N, level_flight().p_N);
  EXPECT_EQ(heading(s), 0);
}

TEST(KinematicPlant, DrawsItsPowerUntilItGlides) {
  KinematicOptions options;
  options.power = 72;
  options.capacity_Wh = 2;  // 100 s
  const KinematicPlant plant(options);
  VehicleState s = fly(plant, level_flight(), {0, 20, 1}, {}, 50, 0.1);
  EXPECT_EQ(s.energy.power, 72);
  EXPECT_NEAR(s.energy.charge, 0.5, 1e-9);
  EXPECT_NEAR(s.p_N.z(), -50, 1e-9);
  s = fly(plant, s, {0, 20, 1}, {}, 60, 0.1);
  EXPECT_EQ(s.energy.charge, 0);
  EXPECT_EQ(s.energy.power, 0);
  EXPECT_NEAR(s.v_N.z(), 1.5, 1e-12);
  EXPECT_NEAR(s.p_N.z(), -100 + 10 * 1.5, 0.3);  // to the step that empties it
}

TEST(KinematicPlant, GlidesWithoutMotorOrBattery) {
  const KinematicPlant plant{KinematicOptions{}};
  VehicleState dead = level_flight(), empty = level_flight();
  dead.faults.dead = 1u << channel::kThrottle;
  empty.faults.battery = true;
  EXPECT_EQ(after(plant, dead, {0, 20, 2}, {}, 0.1).v_N.z(), 1.5);
  EXPECT_EQ(after(plant, empty, {0, 20, -2}, {}, 0.1).v_N.z(), 2);
  EXPECT_EQ(after(plant, level_flight(), {0, 20, 2}, {}, 0.1).energy.charge, 1);
}

}  // namespace
}  // namespace skein::asset::kinematic_plant_test
