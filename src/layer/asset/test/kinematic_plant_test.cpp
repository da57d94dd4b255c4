#include "layer/asset/kinematic_plant.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::asset {
namespace {

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
  for (int i = 0; i < steps; ++i) state = plant.step(state, command, air, dt);
  return state;
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
  EXPECT_NEAR(std::abs(s.heading), geo::kPi, 1e-9);
  EXPECT_NEAR(s.roll, plant.roll_limit(), 1e-12);
}

TEST(KinematicPlant, StepSizeDoesNotMatter) {
  const KinematicPlant plant{KinematicOptions{}};
  const Air air{{3, -5, 0}, 1.2};
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
    EXPECT_NEAR(s.heading, fine.heading, 1e-6) << dt;
    EXPECT_NEAR(s.airspeed, fine.airspeed, 1e-9) << dt;
  }
}

TEST(KinematicPlant, WindCarriesTheFlightAlong) {
  const KinematicPlant plant{KinematicOptions{}};
  const Air wind{{4, -7, 0.5}, 1.2};
  const FlightCommand turn{0.4, 20, 0};
  const VehicleState still = fly(plant, level_flight(), turn, {}, 30, 0.05);
  const VehicleState blown = fly(plant, level_flight(), turn, wind, 30, 0.05);
  EXPECT_LT((blown.p_N - still.p_N - 30 * wind.wind_N).norm(), 1e-9);
  EXPECT_LT((blown.v_N - still.v_N - wind.wind_N).norm(), 1e-12);
}

TEST(KinematicPlant, KeepsItsBounds) {
  const KinematicPlant plant{KinematicOptions{}};
  VehicleState s = level_flight();
  s = plant.step(s, {-5, 100, 50}, {}, 0.2);
  EXPECT_NEAR(s.roll, -0.2, 1e-12);  // 1 rad/s
  EXPECT_NEAR(s.v_N.z(), -3, 1e-12);
  s = fly(plant, s, {-5, 100, 50}, {}, 60, 0.1);
  EXPECT_NEAR(s.roll, -plant.roll_limit(), 1e-12);
  EXPECT_NEAR(s.airspeed, 25, 1e-9);
  EXPECT_NEAR(s.v_N.norm(), 25, 1e-6);
  s = fly(plant, s, {0, 0, 0}, {}, 60, 0.1);
  EXPECT_NEAR(s.airspeed, 15, 1e-9);
}

TEST(KinematicPlant, AirspeedAndRollFollowTheirLaws) {
  const KinematicPlant plant{KinematicOptions{}};
  const VehicleState s = plant.step(level_flight(), {0.3, 24, 0}, {}, 2.0);
  EXPECT_NEAR(s.airspeed, 24 - 4 * std::exp(-1.0), 1e-12);
  EXPECT_EQ(s.roll, 0.3);
  const VehicleState half = plant.step(level_flight(), {0.3, 20, 0}, {}, 0.15);
  EXPECT_NEAR(half.roll, 0.15, 1e-12);
}

TEST(KinematicPlant, NoTimeChangesNothing) {
  const KinematicPlant plant{KinematicOptions{}};
  const VehicleState s = plant.step(level_flight(), {0.3, 24, 1}, {}, 0);
  EXPECT_EQ(s.p_N, level_flight().p_N);
  EXPECT_EQ(s.heading, 0);
}

}  // namespace
}  // namespace skein::asset
