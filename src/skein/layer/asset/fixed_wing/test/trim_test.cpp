// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/trim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/asset/fixed_wing/open_loop.h"
#include "skein/layer/asset/fixed_wing/test/aircraft.h"

namespace skein::asset::trim_test {
namespace {

// Flown on with the trim's deflections and thrust, nothing changes but place and heading.
void expect_equilibrium(const FixedWingModel& model, const TrimRequest& request,
                        double duration) {
  const TrimResult result = find_trim(model, request, TrimThrust::kDirect);
  ASSERT_TRUE(result.found()) << reason(model, result);
  const Trim& trim = result.trim;
  EXPECT_LT(trim.residual, 1e-11);
  const Vec3 wind(3, -5, 0);
  const Motion start = trimmed_motion(trim, {0, 0, -request.altitude_msl}, 0.7, wind);
  std::vector<OpenLoopInput> rows(2);
  rows[1].t = duration;
  for (OpenLoopInput& row : rows) {
    row.surfaces = trim.surfaces;
    row.thrust = trim.thrust;
    row.wind_N = wind;
  }
  const OpenLoopOutput end = fly_open_loop(model, start, rows).back();
  // An unstable spiral lets rounding grow, by e^6 in a minute.
  EXPECT_NEAR(end.airspeed, request.airspeed, 1e-8);
  EXPECT_NEAR(end.alpha, trim.alpha, 1e-9);
  EXPECT_NEAR(end.beta, trim.beta, 1e-9);
  const geo::Euler e = geo::to_euler(end.motion.q_NB);
  EXPECT_NEAR(e.roll, trim.roll, 1e-8);
  EXPECT_NEAR(e.pitch, trim.pitch, 1e-9);
  EXPECT_NEAR(geo::wrap_pi(e.yaw - 0.7 - request.turn_rate * duration), 0, 1e-6);
  EXPECT_NEAR(-end.motion.p_N.z() - request.altitude_msl,
              request.airspeed * std::sin(request.climb_angle) * duration, 1e-6);
}

TEST(Trim, LevelFlightStaysForAMinute) {
  expect_equilibrium(FixedWingModel(aerosonde()), {25, 0, 0, 300}, 60);
  expect_equilibrium(FixedWingModel(glider()), {15, 0, 0, 300}, 60);
  expect_equilibrium(FixedWingModel(light_sport()), {50, 0, 0, 1000}, 60);
}

TEST(Trim, TurnStaysForAMinute) {
  expect_equilibrium(FixedWingModel(aerosonde()), {25, 0, 0.25, 300}, 60);
  expect_equilibrium(FixedWingModel(glider()), {13, 0, -0.4, 300}, 60);
  expect_equilibrium(FixedWingModel(light_sport()), {45, 0, 0.15, 1000}, 60);
}

TEST(Trim, ClimbingTurnBalancesAtItsHeight) {
  const FixedWingModel model(aerosonde());
  // The air thins on the way up, so it is no equilibrium for long: see that it is one.
  const TrimResult result = find_trim(model, {24, 0.12, 0.2, 2000});
  ASSERT_TRUE(result.found()) << reason(model, result);
  EXPECT_LT(result.trim.residual, 1e-11);
  const Motion m = trimmed_motion(result.trim, {0, 0, -2000}, 0, Vec3::Zero());
  EXPECT_NEAR(-m.v_N.z(), 24 * std::sin(0.12), 1e-12);
  // It turns about the vertical only.
  EXPECT_LT((rotation(m.q_NB) * m.w_NB_B - Vec3(0, 0, 0.2)).norm(), 1e-15);
}

TEST(Trim, TurnIsCoordinated) {
  const FixedWingModel model(aerosonde());
  for (const double rate : {-0.3, 0.1, 0.3}) {
    const Trim t = find_trim(model, {25, 0, rate, 300}).trim;
    // The ball in the middle: lift alone turns, so tan(roll) is nearly V rate / g.
    EXPECT_NEAR(std::tan(t.roll), 25 * rate / kGravity,
                0.02 * std::abs(std::tan(t.roll)));
    EXPECT_LT(std::abs(t.beta), 0.05);
  }
}

TEST(Trim, AnAircraftWithoutRudderTurnsOnAilerons) {
  FixedWingParameters p = glider();
  p.servos.rudder_max = 0;
  const FixedWingModel model(p);
  const TrimResult result = find_trim(model, {14, 0, 0.3, 100});
  ASSERT_TRUE(result.found()) << reason(model, result);
  EXPECT_EQ(result.trim.surfaces.rudder, 0);
  EXPECT_NE(result.trim.beta, 0);
}

TEST(Trim, SaysWhyThereIsNone) {
  const auto outcome = [](const FixedWingParameters& p, const TrimRequest& request) {
    const FixedWingModel model(p);
    const TrimResult result = find_trim(model, request);
    EXPECT_EQ(result.found(), reason(model, result).empty());
    return result.outcome;
  };
  EXPECT_EQ(outcome(glider(), {15}), TrimOutcome::kFound);
  EXPECT_EQ(outcome(glider(), {6.5}), TrimOutcome::kStalled);
  EXPECT_EQ(outcome(aerosonde(), {15}), TrimOutcome::kElevatorTooSmall);
  EXPECT_EQ(outcome(glider(), {15, 0.6}), TrimOutcome::kThrustTooSmall);
  EXPECT_EQ(outcome(glider(), {15, -0.4}), TrimOutcome::kThrustNegative);
  EXPECT_EQ(outcome(glider(), {30}), TrimOutcome::kThrustTooSmall);
  EXPECT_EQ(outcome(glider(), {0.1}), TrimOutcome::kStalled);
  EXPECT_EQ(outcome(glider(), {9, 0, 1.6}), TrimOutcome::kStalled);
  FixedWingParameters p = glider();
  p.servos.aileron_max = 1e-4;  // less than the propeller's torque needs
  EXPECT_EQ(outcome(p, {15}), TrimOutcome::kAileronTooSmall);
  p = glider();
  p.servos.rudder_max = 1e-4;
  EXPECT_EQ(outcome(p, {15}), TrimOutcome::kRudderTooSmall);
  p = glider();
  p.propulsion = std::monostate{};
  EXPECT_EQ(outcome(p, {15}), TrimOutcome::kThrustTooSmall);
}

TEST(Trim, IsFoundOverTheWholeEnvelope) {
  for (const FixedWingParameters& p : {aerosonde(), glider(), light_sport()}) {
    const FixedWingModel model(p);
    const Envelope& e = p.envelope;
    for (const double V : {e.slowest, e.cruise, e.fastest})
      for (const double climb : {-0.2, 0.0, 0.05})
        for (const double bank : {-0.5, 0.0, 0.5})
          for (const double altitude : {0.0, 1500.0}) {
            const TrimRequest request{V, climb, kGravity * std::tan(bank) / V, altitude};
            const TrimResult result = find_trim(model, request, TrimThrust::kDirect);
            EXPECT_LT(result.trim.residual, 1e-9) << V << " " << climb << " " << bank;
            EXPECT_TRUE(result.found() || result.outcome == TrimOutcome::kStalled ||
                        result.outcome == TrimOutcome::kElevatorTooSmall)
                << reason(model, result);
          }
  }
}

}  // namespace
}  // namespace skein::asset::trim_test
