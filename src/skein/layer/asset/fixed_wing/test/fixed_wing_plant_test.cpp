// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "skein/base/random.h"
#include "skein/base/test/allocations.h"
#include "skein/layer/asset/fixed_wing/open_loop.h"
#include "skein/layer/asset/fixed_wing/test/aircraft.h"
#include "skein/layer/asset/fixed_wing/trim.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset::fixed_wing_plant_test {
namespace {

using channel::kAileron;
using channel::kElevator;
using channel::kRudder;
using channel::kThrottle;

// The channels that keep a trim.
Actuators channels_of(const FixedWingModel& model, const Trim& trim) {
  Actuators u;
  u[kAileron] = trim.surfaces.aileron / model.servos.aileron_max;
  u[kElevator] = trim.surfaces.elevator / model.servos.elevator_max;
  u[kRudder] = trim.surfaces.rudder / model.servos.rudder_max;
  u[kThrottle] = trim.throttle;
  return u;
}

Actuators cruise_channels(const FixedWingPlant& plant, double altitude) {
  const double V = plant.limits().airspeed;
  return channels_of(plant.model(), find_trim(plant.model(), {V, 0, 0, altitude}).trim);
}

void fly(const FixedWingPlant& plant, VehicleState& state, const Actuators& u,
         const Air& air, double duration, double dt = 0.01) {
  const int steps = static_cast<int>(std::lround(duration / dt));
  for (int i = 0; i < steps; ++i) plant.step(state, u, air, dt);
}

double energy(const FixedWingModel& model, const VehicleState& s, const Vec3& wind_N) {
  return 0.5 * s.w_NB_B.dot(model.body.inertia() * s.w_NB_B) +
         model.body.mass() *
             (0.5 * (s.v_N - wind_N).squaredNorm() - kGravity * s.p_N.z());
}

bool finite(const VehicleState& s) {
  return s.p_N.allFinite() && s.v_N.allFinite() && s.q_NB.coeffs().allFinite() &&
         s.w_NB_B.allFinite() && std::isfinite(s.airspeed);
}

TEST(FixedWingPlant, StartsInTrimmedFlightThroughTheWind) {
  const Vec3 wind(4, -6, 0);
  for (const FixedWingParameters& p : {aerosonde(), glider(), light_sport()}) {
    const FixedWingPlant plant(p);
    const VehicleState start = plant.start({{10, 20, -300}, 1.2, wind, false});
    EXPECT_NEAR((start.v_N - wind).norm(), p.envelope.cruise, 1e-12);
    EXPECT_NEAR(geo::to_euler(start.q_NB).yaw, 1.2, 1e-12);
    VehicleState state = start;
    fly(plant, state, cruise_channels(plant, 300), {wind}, 5);
    // The battery's voltage falls under the load by some per cent, the rest stays.
    EXPECT_NEAR(state.airspeed, p.envelope.cruise, 0.1);
    EXPECT_NEAR(state.p_N.z(), -300, 0.5);
    EXPECT_NEAR(geo::to_euler(state.q_NB).roll, geo::to_euler(start.q_NB).roll, 0.02);
    EXPECT_LT(state.energy.charge, 1);
    EXPECT_GT(state.energy.power, 0);
  }
}

TEST(FixedWingPlant, FliesLikeTheOpenLoopWhenServosAndEngineStandStill) {
  const FixedWingPlant plant(aerosonde());
  VehicleState state = plant.start({{0, 0, -300}, 0.5, {2, 1, 0}, false});
  state.v_N += Vec3(1, -2, 0.5);
  state.w_NB_B = {0.3, -0.1, 0.2};
  state.actuators[kThrottle] = 0;
  Actuators u = cruise_channels(plant, 300);
  u[kThrottle] = 0;
  const Motion start = motion_of(state);
  std::vector<OpenLoopInput> rows(2);
  rows[1].t = 20;
  for (OpenLoopInput& row : rows) {
    row.surfaces = {state.actuators[kAileron], state.actuators[kElevator],
                    state.actuators[kRudder]};
    row.wind_N = {2, 1, 0};
  }
  const Motion end =
      fly_open_loop(plant.model(), start, rows, {.longest_step = 0.01}).back().motion;
  fly(plant, state, u, {{2, 1, 0}}, 20);
  // Equal but for the density's expansion within a step.
  EXPECT_LT((state.p_N - end.p_N).norm(), 1e-7);
  EXPECT_LT((state.v_N - end.v_N).norm(), 1e-8);
}

// The longest steps of the outside, and what they cost.
TEST(FixedWingPlant, StepSizeMattersLittle) {
  for (const FixedWingParameters& p : {aerosonde(), glider(), light_sport()}) {
    const FixedWingPlant plant(p);
    const auto end = [&](double dt) {
      VehicleState state = plant.start({{0, 0, -300}, 0.5, Vec3::Zero(), false});
      Actuators u = cruise_channels(plant, 300);
      for (const double aileron : {0.1, -0.1, 0.0}) {
        u[kAileron] += aileron;
        fly(plant, state, u, {}, 2, dt);
      }
      return state;
    };
    const VehicleState exact = end(0.001);
    for (const double dt : {0.01, 0.02, 0.1}) {
      const VehicleState s = end(dt);
      // The servos' corners within a step cost most.
      EXPECT_LT((s.p_N - exact.p_N).norm(), 0.01) << dt;
      EXPECT_LT((s.v_N - exact.v_N).norm(), 0.01) << dt;
    }
  }
}

TEST(FixedWingPlant, GustRatesActLikeBodyRates) {
  const FixedWingPlant plant(glider());
  const VehicleState start = plant.start({{0, 0, -300}, 0, Vec3::Zero(), false});
  const Actuators u = cruise_channels(plant, 300);
  const double dt = 1e-5;
  const auto acceleration = [&](const Vec3& body_rates, const Vec3& air_rates) -> Vec3 {
    VehicleState s = start;
    s.w_NB_B = body_rates;
    plant.step(s, u, {Vec3::Zero(), air_rates}, dt);
    return (s.w_NB_B - body_rates) / dt;
  };
  // Small rates about one axis at a time make no gyroscopic moments.
  for (const Vec3& axis :
       {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
    const Vec3 by_body = acceleration(0.01 * axis, Vec3::Zero());
    const Vec3 by_air = acceleration(Vec3::Zero(), -0.01 * axis);
    EXPECT_LT((by_body - by_air).norm(), 2e-3 * by_body.norm() + 1e-3);
    EXPECT_GT(by_body.norm(), 0.01);
  }
}

TEST(FixedWingPlant, ServosHaveARateAndALag) {
  FixedWingParameters p = glider();
  const FixedWingPlant plant(p);
  VehicleState state = plant.start({{0, 0, -300}, 0, Vec3::Zero(), false});
  state.actuators[kRudder] = 0;
  Actuators u = cruise_channels(plant, 300);
  u[kRudder] = 1;
  const double largest = p.servos.rudder_max, rate = p.servos.rate, lag = p.servos.lag;
  // Full speed as long as the lag would ask for more: until rate * lag before the end.
  const double corner = (largest - rate * lag) / rate;
  double t = 0;
  for (int i = 0; i < 40; ++i) {
    plant.step(state, u, {}, 0.01);
    t += 0.01;
    const double expected =
        t < corner ? rate * t : largest - rate * lag * std::exp(-(t - corner) / lag);
    EXPECT_NEAR(state.actuators[kRudder], expected, 1e-12) << t;
  }
  u[kRudder] = -7;  // bounded
  fly(plant, state, u, {}, 2);
  EXPECT_NEAR(state.actuators[kRudder], -largest, 1e-9);
  u[kRudder] = std::nan("");
  fly(plant, state, u, {}, 2);
  EXPECT_NEAR(state.actuators[kRudder], 0, 1e-9);
  EXPECT_TRUE(finite(state));
}

TEST(FixedWingPlant, EngineFollowsWithItsLag) {
  const FixedWingPlant plant(light_sport());
  VehicleState state = plant.start({{0, 0, -300}, 0, Vec3::Zero(), false});
  const double before = state.actuators[kThrottle];
  Actuators u = cruise_channels(plant, 300);
  u[kThrottle] = 1;
  fly(plant, state, u, {}, 0.4);  // one time constant
  EXPECT_NEAR(state.actuators[kThrottle], 1 - (1 - before) * std::exp(-1), 1e-9);
}

TEST(FixedWingPlant, DeadAndStuckActuators) {
  const FixedWingPlant plant(glider());
  const Actuators u = cruise_channels(plant, 300);
  VehicleState state = plant.start({{0, 0, -300}, 0, Vec3::Zero(), false});
  state.actuators[kElevator] = 0.1;
  state.faults.stuck = 1u << kElevator;
  state.faults.dead = 1u << kRudder | 1u << kThrottle;
  state.actuators[kRudder] = 0.2;
  Actuators other = u;
  other[kElevator] = -1;
  other[kRudder] = 1;
  other[kThrottle] = 1;
  fly(plant, state, other, {}, 2);
  EXPECT_EQ(state.actuators[kElevator], 0.1);
  EXPECT_NEAR(state.actuators[kRudder], 0, 1e-12);
  EXPECT_EQ(state.actuators[kThrottle], 0);
  EXPECT_EQ(state.energy.power, 0);
}

TEST(FixedWingPlant, MotorStandsWithoutEnergy) {
  const FixedWingPlant plant(glider());
  const Actuators u = cruise_channels(plant, 300);
  for (const bool failed : {false, true}) {
    VehicleState state = plant.start({{0, 0, -300}, 0, Vec3::Zero(), false});
    if (failed)
      state.faults.battery = true;
    else
      state.energy.charge = 1e-4;
    fly(plant, state, u, {}, 5);
    EXPECT_EQ(state.actuators[kThrottle], 0);
    EXPECT_LT(-state.p_N.z(), 300);
    EXPECT_TRUE(finite(state));
  }
}

TEST(FixedWingPlant, BatteryLastsAsLongAsItsEnergy) {
  const FixedWingPlant plant(glider());
  VehicleState state = plant.start({{0, 0, -300}, 0, Vec3::Zero(), false});
  const double power = find_trim(plant.model(), {15, 0, 0, 300}).trim.power;
  fly(plant, state, cruise_channels(plant, 300), {}, 60);
  // 2.2 Ah at about 12.4 V; the phugoid makes the power go up and down a little.
  EXPECT_NEAR(1 - state.energy.charge, power * 60 / (2.2 * 3600 * 12.4), 0.1 * 0.034);
}

TEST(FixedWingPlant, FliesLevelDownToItsMinimumDensity) {
  for (const FixedWingParameters& p : {aerosonde(), glider(), light_sport()}) {
    const FixedWingPlant plant(p);
    EXPECT_EQ(span_of(plant.airframe()), p.geometry.span);
    // Whether there is level flight at an altitude, fast enough for the lift reserve.
    const auto flies = [&](double altitude) {
      const double density = model::standard_air(altitude).density;
      const double min = p.envelope.slowest * std::sqrt(1.225 / density);
      for (double V = min; V <= p.envelope.fastest; V += 0.25)
        if (find_trim(plant.model(), {V, 0, 0, altitude}).found()) return true;
      return false;
    };
    // The ceiling is found to 8 m, by three airspeeds only: 3 % of it for the others.
    const double ceiling = model::standard_altitude(plant.limits().min_density);
    EXPECT_GT(ceiling, 2000);
    EXPECT_TRUE(flies(ceiling - 10));
    EXPECT_FALSE(flies(1.03 * ceiling + 10));
  }
}

TEST(FixedWingPlant, ClimbsAndSinksAsItSays) {
  for (const FixedWingParameters& p : {aerosonde(), glider(), light_sport()}) {
    const FixedWingPlant plant(p);
    const auto frame = std::get<FixedWingAirframe>(plant.airframe());
    const FlightLimits limits = plant.limits();
    EXPECT_GT(limits.climb_rate, 1);
    EXPECT_GT(limits.sink_rate, 1);
    // What it says keeps a reserve of a fifth.
    const double V = p.envelope.cruise;
    const auto found = [&](double rate) {
      return find_trim(plant.model(), {V, std::asin(rate / V)}).outcome;
    };
    EXPECT_EQ(found(limits.climb_rate), TrimOutcome::kFound);
    EXPECT_EQ(found(1.24 * limits.climb_rate), TrimOutcome::kFound);
    EXPECT_EQ(found(1.26 * limits.climb_rate), TrimOutcome::kThrustTooSmall);
    EXPECT_EQ(found(-1.24 * limits.sink_rate), TrimOutcome::kFound);
    EXPECT_EQ(found(-1.26 * limits.sink_rate), TrimOutcome::kThrustNegative);
    // And its answers are those of the motion.
    EXPECT_GT(frame.roll_damping, 1);
    EXPECT_GT(frame.elevator_power, 1);
    EXPECT_GT(frame.rudder_power, 0);
    EXPECT_NEAR(frame.trim_throttle, find_trim(plant.model(), {V}).trim.throttle, 1e-12);
    const double lift = frame.lift_slope * frame.mass * V;  // [N/rad]
    const double qS = 0.5 * 1.225 * V * V * p.geometry.area;
    EXPECT_NEAR(lift / qS, p.aero.CLa, 0.02 * p.aero.CLa);
  }
}

TEST(FixedWingPlant, GliderWithoutMotorGlides) {
  FixedWingParameters p = glider();
  p.propulsion = std::monostate{};
  ASSERT_TRUE(errors(p).empty());
  const FixedWingPlant plant(p);
  const auto frame = std::get<FixedWingAirframe>(plant.airframe());
  EXPECT_FALSE(frame.motor);
  EXPECT_EQ(frame.climb_rate, 0);
  VehicleState state = plant.start({{0, 0, -300}, 0, Vec3::Zero(), false});
  Actuators u;
  u[kElevator] = frame.trim_elevator;
  fly(plant, state, u, {}, 10);
  EXPECT_NEAR(state.airspeed, 15, 0.2);
  EXPECT_NEAR((300 + state.p_N.z()) / 10, frame.sink_rate / 0.8, 0.1);
}

TEST(FixedWingPlant, StandsOnTheGround) {
  const FixedWingPlant plant(light_sport());
  VehicleState state = plant.start({{0, 0, -120}, 0.4, {3, 0, 0}, true});
  const VehicleState before = state;
  for (int i = 0; i < 500; ++i) {
    plant.step(state, Actuators{}, {{3, 0, 0}}, 0.01);
    if (-state.p_N.z() < 120) {
      ASSERT_EQ(plant.touch(state, 120, 0.01), Contact::kRests);
    }
  }
  EXPECT_TRUE(state.on_ground);
  EXPECT_LT((state.p_N - before.p_N).norm(), 0.2);
}

// Any attitude, rate, speed, wind and rudder: the state stays finite, and without motor
// the aircraft gains no energy from the air at rest around it.
TEST(FixedWingPlant, TumblesThroughAnythingWithoutBlowingUp) {
  RandomStream random(20260, 1, Purpose::kTest);
  const auto vector = [&](double size) {
    return Vec3(random.uniform(-size, size), random.uniform(-size, size),
                random.uniform(-size, size));
  };
  const FixedWingPlant plants[] = {FixedWingPlant(aerosonde()), FixedWingPlant(glider()),
                                   FixedWingPlant(light_sport())};
  double max_gain = -1;
  for (int k = 0; k < 10'000; ++k) {
    const FixedWingPlant& plant = plants[k % 3];
    VehicleState state = plant.start({{0, 0, -1000}, 0, Vec3::Zero(), false});
    const double fastest = plant.limits().fastest;
    state.q_NB = geo::exp_so3(vector(geo::kPi));
    state.v_N = vector(1.5 * fastest);
    state.w_NB_B = vector(10);
    const bool motor = k % 2 == 0;
    if (!motor) state.actuators[kThrottle] = 0;
    Actuators u;
    for (const std::size_t c : {kAileron, kElevator, kRudder})
      u[c] = random.uniform(-1, 1);
    u[kThrottle] = motor ? random.uniform() : 0;
    const Air air{vector(10), motor ? vector(0.5) : Vec3(Vec3::Zero())};
    const double weight = plant.model().body.mass() * kGravity;
    const double before = energy(plant.model(), state, air.wind_N);
    fly(plant, state, u, air, 5);
    ASSERT_TRUE(finite(state)) << k;
    ASSERT_LT(state.airspeed, 400) << k;
    ASSERT_LT(state.w_NB_B.norm(), 200) << k;
    if (!motor) {
      // In the frame of the wind, which carries the heights along.
      const double gain =
          energy(plant.model(), state, air.wind_N) - before + 5 * air.wind_N.z() * weight;
      max_gain = std::max(max_gain, gain / (before - 1000 * weight));
    }
  }
  // Of the kinetic energy at the start; drag has taken a part from each.
  EXPECT_LT(max_gain, 0);
}

TEST(FixedWingPlant, StepsWithoutAllocating) {
  const FixedWingPlant plant(glider());
  VehicleState state = plant.start({{0, 0, -300}, 0, Vec3::Zero(), false});
  const Control control = cruise_channels(plant, 300);
  const auto before = allocations();
  if (!before) GTEST_SKIP() << "the sanitizer's own malloc prevents it";
  for (int i = 0; i < 100; ++i) plant.step(state, control, {}, 0.01);
  EXPECT_EQ(allocations(), before);
  EXPECT_NE(std::make_unique<FixedWingPlant>(glider()), nullptr);
  EXPECT_GT(allocations(), before);  // the counter works
}

}  // namespace
}  // namespace skein::asset::fixed_wing_plant_test
