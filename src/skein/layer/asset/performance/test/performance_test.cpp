// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/base/random.h"
#include "skein/layer/asset/performance/performance_plant.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset::performance_test {
namespace {

constexpr double kStep = 0.1;

Air air_at(double altitude) {
  Air air;
  air.density = model::standard_air(altitude).density;
  return air;
}

double climb_rate(const VehicleState& s, const Air& air = {}) {
  return air.wind_N.z() - s.v_N.z();
}
double roll(const VehicleState& s) {
  return geo::to_euler(s.q_NB).roll;
}

VehicleState fly(const PerformancePlant& plant, VehicleState s,
                 const FlightCommand& command, const Air& air, double seconds,
                 double dt = kStep) {
  const auto steps = static_cast<int>(std::lround(seconds / dt));
  for (int i = 0; i < steps; ++i) plant.step(s, command, air, dt);
  return s;
}

TEST(PerformancePlant, HoldsItsHeightDownToItsMinimumDensity) {
  const PerformancePlant plant{PerformanceParameters{}};
  const auto climb_in = [&](double density) {
    double best = -1e9;
    for (double v = 30; v <= 64; v += 2) {
      Air air;
      air.density = density;
      best = std::max(best, climb_rate(fly(plant, plant.start({}), {0, v, 0}, air, 120)));
    }
    return best;
  };
  const double min = plant.limits().min_density;
  EXPECT_LT(min, 1);
  // Where its power just holds it, 3 % of density are 4 % of power: some 0.1 m/s.
  EXPECT_NEAR(climb_in(1.03 * min), 0, 1e-3);
  EXPECT_LT(climb_in(0.97 * min), -0.01);
}

TEST(PerformancePlant, ItsSpanIsWhatItsInducedDragImplies) {
  // The P2002 has 8.6 m; the rule's efficiency of 0.8 is good to a tenth.
  EXPECT_NEAR(span_of(PerformancePlant{PerformanceParameters{}}.airframe()), 8.6, 0.4);
}

TEST(PerformancePlant, StartsInLevelFlight) {
  const PerformancePlant plant{PerformanceParameters{}};
  VehicleState s = plant.start({{0, 0, -500}, 1, {3, 0, 0}, false});
  const double throttle = s.actuators[channel::kThrottle];
  Air air = air_at(0);
  air.wind_N = {3, 0, 0};
  s = fly(plant, s, {0, 50, 0}, air, 20);
  EXPECT_NEAR(s.p_N.z(), -500, 1e-9);
  EXPECT_NEAR(s.airspeed, 50, 1e-9);
  EXPECT_NEAR(s.p_N.x(), 20 * (50 * std::cos(1.0) + 3), 1e-6);
  EXPECT_NEAR(s.actuators[channel::kThrottle], throttle, 1e-3);  // it gets lighter
  EXPECT_GT(throttle, 0.4);
  EXPECT_LT(throttle, 0.75);
}

TEST(PerformancePlant, ClimbFallsWithHeightToACeiling) {
  const PerformanceParameters p;
  const PerformancePlant plant(p);
  double last = 100, ceiling = 0;
  for (double altitude = 0; altitude < 9000; altitude += 250) {
    const Air air = air_at(altitude);
    // True airspeed of about 36 m/s of pressure: where it climbs well.
    const double airspeed = std::min(p.fastest, 36 * std::sqrt(1.225 / air.density));
    VehicleState s = plant.start({});
    s.airspeed = airspeed;
    plant.step(s, FlightCommand{0, airspeed, p.climb_rate}, air, kStep);
    const double climb = climb_rate(s);
    EXPECT_LT(climb, last) << altitude;
    if (altitude == 0) {
      EXPECT_NEAR(climb, 5.6, 0.3);  // 1,100 ft/min
    }
    if (climb > 0) ceiling = altitude;
    last = climb;
  }
  EXPECT_LT(last, 0);
  EXPECT_GT(ceiling, 4000);
  EXPECT_LT(ceiling, 7000);
}

TEST(PerformancePlant, ReachesItsCeilingAndStays) {
  const PerformancePlant plant{PerformanceParameters{}};
  VehicleState s = plant.start({{0, 0, -5000}, 0, Vec3::Zero(), false});
  const auto climb_for = [&](int seconds) {
    for (int i = 0; i < seconds; ++i) {
      s.energy.charge = 1;  // no lighter
      plant.step(s, FlightCommand{0, 48, 6}, air_at(-s.p_N.z()), 1);
    }
    return -s.p_N.z();
  };
  const double near = climb_for(9000);
  EXPECT_GT(near, 5100);
  // It comes nearer to the ceiling by a factor of e in some 20 minutes.
  EXPECT_NEAR(climb_for(100), near, 1);
}

TEST(PerformancePlant, GlidesWithLiftOverDrag) {
  const PerformanceParameters p;
  const PerformancePlant plant(p);
  for (const double airspeed : {35.0, 45.0}) {
    VehicleState s = plant.start({});
    s.airspeed = airspeed;
    const double weight = plant.model().mass(1) * kGravity;
    plant.step(s, FlightCommand{0, airspeed, -p.sink_rate}, {}, 0.01);
    const double ratio = geo::horizontal(s.v_N).norm() / s.v_N.z();
    const double lift_over_drag =
        weight / plant.model().drag(airspeed, weight, kSeaLevel);
    // Lift is taken to be the weight: off by half the glide angle's square.
    EXPECT_NEAR(ratio, lift_over_drag, 0.01 * lift_over_drag);
    EXPECT_EQ(s.actuators[channel::kThrottle], 0);
  }
  // The best there is, by hand.
  EXPECT_NEAR(1 / (2 * std::sqrt(p.zero_lift_drag * p.induced_drag)), 12.0, 0.1);
}

TEST(PerformancePlant, ADeadMotorGlides) {
  const PerformancePlant plant{PerformanceParameters{}};
  VehicleState s = plant.start({});
  s.faults.dead = 1u << channel::kThrottle;
  const double fuel = s.energy.charge;
  s = fly(plant, s, {0, 40, 3}, {}, 20);
  EXPECT_NEAR(s.airspeed, 40, 0.1);
  EXPECT_LT(climb_rate(s), -2.5);
  EXPECT_GT(s.energy.charge, fuel - 1e-3);  // it runs idle at most
}

TEST(PerformancePlant, EnergyOfFlightIsWhatThrustLeaves) {
  const PerformanceParameters p;
  const PerformancePlant plant(p);
  VehicleState s = plant.start({});
  const double mass = plant.model().mass(1), dt = 0.01;
  double work = 0;
  const auto energy = [&] {
    return mass * (0.5 * s.airspeed * s.airspeed - kGravity * s.p_N.z());
  };
  const double before = energy();
  for (int i = 0; i < 3000; ++i) {
    const FlightCommand command{i < 1000 ? 0.5 : 0.0, i < 2000 ? 55.0 : 40.0,
                                i < 1500 ? 4.0 : -3.0};
    s.energy.charge = 1;  // no lighter
    const double v = s.airspeed;
    plant.step(s, command, {}, dt);
    const double thrust =
        plant.model().thrust(s.actuators[channel::kThrottle] * p.power, v);
    work +=
        dt * v *
        (thrust - plant.model().drag(v, mass * kGravity / std::cos(roll(s)), kSeaLevel));
  }
  // The sum takes the beginning of each step for the whole: the thrust of the
  // command's step changes at once, some 2 kN times 50 m/s times 10 ms.
  EXPECT_NEAR(energy() - before, work, 1000);
  EXPECT_GT(std::abs(energy() - before), 5e4);
}

TEST(PerformancePlant, AcceleratingAndClimbingShareThePower) {
  const PerformanceParameters p;
  const PerformancePlant plant(p);
  VehicleState s = plant.start({});
  s.airspeed = 40;
  plant.step(s, FlightCommand{0, 60, 6}, {}, 0.01);
  const double acceleration = (s.airspeed - 40) / 0.01;
  const double weight = plant.model().mass(1) * kGravity;
  const double excess =
      (plant.model().thrust(p.power, 40) - plant.model().drag(40, weight, kSeaLevel)) *
      40 / weight;
  EXPECT_GT(acceleration, 0.1);
  EXPECT_GT(climb_rate(s), 0.5);
  EXPECT_NEAR(climb_rate(s) + 40 * acceleration / kGravity, excess, 1e-2);
}

TEST(PerformancePlant, BurnsFuelByPower) {
  const PerformanceParameters p;
  const PerformancePlant plant(p);
  VehicleState s = plant.start({});
  s = fly(plant, s, {0, 50, 0}, {}, 3600, 1);
  const double weight = plant.model().mass((1 + s.energy.charge) / 2) * kGravity;
  const double shaft = plant.model().power(plant.model().drag(50, weight, kSeaLevel), 50);
  const double burnt = (p.tank.consumption * shaft + p.tank.idle_consumption) * 3600;
  EXPECT_NEAR((1 - s.energy.charge) * p.tank.fuel, burnt, 1e-3 * burnt);
  EXPECT_GT(burnt, 8);  // 0.72 kg/l: 12 to 20 l/h
  EXPECT_LT(burnt, 14);
}

TEST(PerformancePlant, WithoutFuelItComesDown) {
  const PerformancePlant plant{PerformanceParameters{}};
  VehicleState s = plant.start({});
  s.energy.charge = 1e-4;
  s = fly(plant, s, {0, 40, 0}, {}, 60);
  EXPECT_EQ(s.energy.charge, 0);
  EXPECT_LT(climb_rate(s), -2.5);
  EXPECT_NEAR(s.airspeed, 40, 0.1);
}

TEST(PerformancePlant, ElectricOnesKeepTheirMass) {
  PerformanceParameters p;
  p.electric = true;
  p.power_lapse = 0;
  const PerformancePlant plant(p);
  ASSERT_EQ(plant.model().mass(1), plant.model().mass(0));
  VehicleState s = plant.start({});
  s = fly(plant, s, {0, 50, 0}, {}, 600);
  const double shaft =
      plant.model().power(plant.model().drag(50, p.mass * kGravity, kSeaLevel), 50);
  EXPECT_NEAR(s.energy.power, shaft / p.motor_efficiency, 1e-6 * shaft);
  EXPECT_LT(s.energy.charge, 0.9);
  EXPECT_GT(s.energy.voltage, 300);
}

TEST(PerformancePlant, TurnsByItsBank) {
  const PerformanceParameters p;
  const PerformancePlant plant(p);
  VehicleState s = plant.start({});
  s = fly(plant, s, {0.5, 50, 0}, {}, 0.5);
  EXPECT_NEAR(roll(s), 0.5 * p.roll_rate, 1e-9);
  s = fly(plant, s, {0.5, 50, 0}, {}, 5);
  EXPECT_NEAR(roll(s), 0.5, 1e-9);
  const double before = geo::yaw(s.q_NB);
  s = fly(plant, s, {0.5, 50, 0}, {}, 1);
  EXPECT_NEAR(geo::yaw(s.q_NB) - before, kGravity * std::tan(0.5) / 50, 1e-9);
}

TEST(PerformancePlant, KeepsAboveTheStallOfItsBank) {
  const PerformanceParameters p;
  const PerformancePlant plant(p);
  VehicleState s = plant.start({});
  const double stall = plant.model().stall_speed(plant.model().mass(1), kSeaLevel);
  s = fly(plant, s, {0.7, 10, 0}, {}, 60);
  EXPECT_NEAR(s.airspeed, p.stall_reserve * stall / std::sqrt(std::cos(0.7)), 0.1);
  s = fly(plant, s, {0, 10, 0}, {}, 60);
  EXPECT_NEAR(s.airspeed, p.slowest, 0.01);
  s = fly(plant, s, {0.7, 10, 0}, {}, 0.1);
  EXPECT_LT(roll(s), p.roll_rate * 0.1 + 1e-9);
}

TEST(PerformancePlant, StepSizeDoesNotMatter) {
  const PerformancePlant plant{PerformanceParameters{}};
  const auto lap = [&](double dt) {
    VehicleState s = plant.start({});
    s = fly(plant, s, {0.4, 55, 3}, {}, 20, dt);
    return fly(plant, s, {-0.3, 40, -2}, {}, 20, dt);
  };
  const VehicleState fine = lap(0.005);
  for (const double dt : {0.02, 0.1, 1.0}) {
    const VehicleState s = lap(dt);
    // The power of a step is that of its beginning: mass and thrust limits lag by it.
    EXPECT_LT((s.p_N - fine.p_N).norm(), 0.5 * dt) << dt;
    EXPECT_NEAR(s.airspeed, fine.airspeed, 0.02 * dt) << dt;
    EXPECT_NEAR(s.energy.charge, fine.energy.charge, 1e-4 * dt + 1e-9) << dt;
  }
}

TEST(PerformancePlant, HeadingChangesNothing) {
  const PerformancePlant plant{PerformanceParameters{}};
  const auto flown = [&](double heading) {
    VehicleState s = plant.start({Vec3::Zero(), heading, Vec3::Zero(), false});
    return fly(plant, s, {0.4, 45, 3}, {}, 20);
  };
  const VehicleState north = flown(0), other = flown(2);
  EXPECT_LT((geo::from_euler({0, 0, 2}) * north.p_N - other.p_N).norm(), 1e-9);
}

TEST(PerformancePlant, StaysFiniteUnderAnyCommand) {
  const PerformancePlant plant{PerformanceParameters{}};
  RandomStream random(3, 0, Purpose::kTest);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double odd[] = {kNan, kInf, -kInf, 1e300, -1e300, 0, 0.5, 30, -5};
  const auto any = [&] { return odd[static_cast<std::size_t>(random.uniform() * 9)]; };
  VehicleState s = plant.start({});
  for (int i = 0; i < 20000; ++i) {
    plant.step(s, FlightCommand{any(), any(), any()}, air_at(2000), 0.05);
    ASSERT_TRUE(s.p_N.allFinite() && s.v_N.allFinite() && s.q_NB.coeffs().allFinite());
    ASSERT_GE(s.airspeed, 29.9);
    ASSERT_LE(s.airspeed, 64.01);
  }
}

TEST(PerformanceParameters, ErrorsNameTheirKeys) {
  EXPECT_TRUE(errors(PerformanceParameters{}).empty());
  const auto only_error = [](const PerformanceParameters& p) {
    const auto found = errors(p);
    return found.size() == 1 ? found[0].key : "";
  };
  PerformanceParameters p;
  p.mass = -1;
  EXPECT_EQ(only_error(p), "mass");
  p = {};
  p.slowest = 25;  // stall is at 24 m/s, its reserve 15 %
  EXPECT_EQ(only_error(p), "slowest");
  p = {};
  p.power = 30000;
  EXPECT_EQ(only_error(p), "cruise");
  p = {};
  p.tank.fuel = 0;
  EXPECT_EQ(only_error(p), "tank.fuel");
}

TEST(PerformanceParameters, OneThatFliesBadlyFliesAllTheSame) {
  PerformanceParameters p;
  p.mass = 900;  // cannot hold cruise, and stalls at its slowest airspeed
  p.power = 30000;
  EXPECT_FALSE(errors(p).empty());
  ASSERT_TRUE(number_errors(p).empty());
  const PerformancePlant plant(p);
  const FlightLimits limits = plant.limits();
  EXPECT_EQ(limits.climb_rate, 0);
  EXPECT_GT(limits.turn_radius, 0);
  VehicleState s = plant.start({});
  s = fly(plant, s, {0.7, 20, 5}, {}, 60);
  EXPECT_TRUE(s.p_N.allFinite());
  EXPECT_LT(climb_rate(s), 0);
}

}  // namespace
}  // namespace skein::asset::performance_test
