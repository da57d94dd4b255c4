// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "skein/base/random.h"
#include "skein/layer/asset/multirotor/multirotor_plant.h"

namespace skein::asset::multirotor_test {
namespace {

constexpr double kStep = 0.01;

MultirotorParameters hexarotor() {
  MultirotorParameters p;
  p.mass = 2.2;
  p.rotors.clear();
  for (int k = 0; k < 6; ++k)
    p.rotors.push_back({0.3 * geo::unit(k * geo::kPi / 3), k % 2 == 0 ? 1.0 : -1.0});
  return p;
}

// The throttles that hold the rotors at their speed.
Actuators holding(const MultirotorParameters& p, const VehicleState& s) {
  Actuators throttles;
  for (std::size_t k = 0; k < p.rotors.size(); ++k)
    throttles[k] = s.actuators[k] / p.fastest_rotor;
  return throttles;
}

VehicleState fly(const Plant& plant, VehicleState s, const Actuators& throttles,
                 const Air& air, double seconds, double dt = kStep) {
  const auto steps = static_cast<int>(std::lround(seconds / dt));
  for (int i = 0; i < steps; ++i) plant.step(s, throttles, air, dt);
  return s;
}

VehicleState tumbling() {
  VehicleState s;
  s.v_N = {6, -3, 2};
  s.q_NB = geo::from_euler({0.5, -0.3, 2});
  s.w_NB_B = {1.5, -2, 1};
  s.actuators = {400, 600, 500, 550};
  return s;
}

TEST(MultirotorPlant, KeepsAReserveOfThrustAtItsMinimumDensity) {
  for (const MultirotorParameters& p : {MultirotorParameters{}, hexarotor()}) {
    const MultirotorPlant plant(p);
    const MultirotorTrim hover = plant.trim({0, 0, 0}, 0, plant.limits().min_density);
    double max = 0;
    for (const double speed : hover.rotors) max = std::max(max, speed);
    // A tenth more thrust than hovering takes; it grows with the square of the speed.
    EXPECT_NEAR(p.fastest_rotor * p.fastest_rotor / (max * max), 1.1, 1e-6);
  }
  EXPECT_NEAR(span_of(MultirotorPlant(MultirotorParameters{}).airframe()),
              2 * (0.177 * std::sqrt(2.0) + 0.127), 1e-12);
}

TEST(MultirotorPlant, HoverInWindIsAnEquilibrium) {
  for (const MultirotorParameters& p : {MultirotorParameters{}, hexarotor()}) {
    const MultirotorPlant plant(p);
    for (const Vec3& wind : {Vec3(0, 0, 0), Vec3(6, -5, 0), Vec3(-3, 0, 1.5)}) {
      Air air;
      air.wind_N = wind;
      const VehicleState begin = plant.start({{10, 20, -100}, 0.7, wind, false});
      EXPECT_NEAR(geo::yaw(begin.q_NB), 0.7, 1e-12);
      const VehicleState s = fly(plant, begin, holding(p, begin), air, 1);
      // The trim converges to 1e-10; an unstable attitude could grow that by e^5.
      EXPECT_LT((s.p_N - begin.p_N).norm(), 1e-7);
      EXPECT_LT(s.v_N.norm(), 1e-7);
      EXPECT_LT(s.w_NB_B.norm(), 1e-7);
      EXPECT_NEAR(s.airspeed, wind.norm(), 1e-7);
    }
  }
}

TEST(MultirotorPlant, HoverTakesTheThrustOfTheWeight) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  const VehicleState s = plant.start({});
  const double speed = std::sqrt(p.mass * kGravity / (4 * p.thrust_factor));
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(s.actuators[k], speed, 1e-9);
}

TEST(MultirotorPlant, ForwardFlightBalancesDragByTilt) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  const MultirotorTrim trim = plant.trim({12, 0, 0}, 0);
  const geo::Euler attitude = geo::to_euler(trim.q_NB);
  EXPECT_NEAR(attitude.roll, 0, 1e-12);
  // Horizontal drag by hand: rotors in the plane and along the axis, and the body.
  double speeds = 0, squares = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    speeds += trim.rotors[k];
    squares += trim.rotors[k] * trim.rotors[k];
  }
  const double c = std::cos(attitude.pitch), s = std::sin(attitude.pitch);
  const double u = 12 * c, w = 12 * s;  // through the air, in the body
  const double fx = -p.rotor_drag * speeds * u - 0.6125 * 12 * p.drag_area.x() * u;
  const double fz = -p.axial_drag * speeds * w - 0.6125 * 12 * p.drag_area.z() * w -
                    p.thrust_factor * squares;
  EXPECT_NEAR(c * fx + s * fz, 0, 1e-9);
  EXPECT_NEAR(-s * fx + c * fz, -p.mass * kGravity, 1e-9);
  EXPECT_LT(attitude.pitch, -0.15);
}

TEST(MultirotorPlant, FallsFreelyWithoutAir) {
  const MultirotorPlant plant{MultirotorParameters{}};
  Air none;
  none.density = 0;
  VehicleState s = tumbling();
  const VehicleState begin = s;
  s = fly(plant, s, {}, none, 2);
  EXPECT_LT((s.v_N - begin.v_N - Vec3(0, 0, 2 * kGravity)).norm(), 1e-12);
  EXPECT_LT((s.p_N - 2 * begin.v_N - Vec3(0, 0, 2 * kGravity)).norm(), 1e-11);
}

TEST(MultirotorPlant, KeepsAngularMomentumWithoutAir) {
  // Rotors that spin up and down only exchange angular momentum with the frame.
  MultirotorParameters p;
  p.rotor_inertia = 1e-3;  // large, to be seen
  const MultirotorPlant plant(p);
  Air none;
  none.density = 0;
  const auto momentum = [&](const VehicleState& s) -> Vec3 {
    Vec3 h = p.inertia.tensor() * s.w_NB_B;
    for (std::size_t k = 0; k < 4; ++k)
      h.z() -= p.rotors[k].spin * p.rotor_inertia * s.actuators[k];
    return s.q_NB * h;
  };
  VehicleState s = tumbling();
  const Vec3 before = momentum(s);
  Actuators throttles;
  throttles.channel = {1, 0.2, 0, 0.9};
  s = fly(plant, s, throttles, none, 1, 1e-3);
  EXPECT_GT(std::abs(s.w_NB_B.z() - 1), 1);  // something did happen
  // RK4 at 1 ms, with rates up to 50 rad/s.
  EXPECT_LT((momentum(s) - before).norm(), 1e-6 * before.norm());
}

TEST(MultirotorPlant, KeepsItsEnergyWithoutAir) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  Air none;
  none.density = 0;
  const auto energy = [&](const VehicleState& s) {
    return 0.5 * p.mass * s.v_N.squaredNorm() +
           0.5 * s.w_NB_B.dot(p.inertia.tensor() * s.w_NB_B) -
           p.mass * kGravity * s.p_N.z();
  };
  VehicleState begin = tumbling();
  begin.actuators = {};
  const VehicleState s = fly(plant, begin, {}, none, 10);
  EXPECT_NEAR(energy(s), energy(begin), 1e-7 * std::abs(energy(begin)));
}

TEST(MultirotorPlant, TurnsByDragTorque) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  VehicleState s = plant.start({});
  Actuators throttles = holding(p, s);
  // More thrust on those whose drag turns clockwise, less on the others.
  for (std::size_t k = 0; k < 4; ++k) throttles[k] += 0.05 * p.rotors[k].spin;
  s = fly(plant, s, throttles, {}, 0.5);
  EXPECT_GT(s.w_NB_B.z(), 0.3);
  EXPECT_LT(std::abs(s.w_NB_B.x()) + std::abs(s.w_NB_B.y()), 1e-9);
  // Torque 2 c (w+^2 - w-^2) less rotor drag's damping, over the inertia; the rotors'
  // spin-up adds its momentum.
  const double plus = s.actuators[0], minus = s.actuators[2];
  const double steady = 2 * p.torque_factor * (plus * plus - minus * minus);
  const double spun_up = p.rotor_inertia * 2 * (plus - minus);
  const double by_hand = (steady * (0.5 - p.motor_lag) + spun_up) / p.inertia.zz;
  // Damping takes 4 d w |r|^2 / I = 0.5 1/s off it, that is 12 % in half a second.
  EXPECT_NEAR(s.w_NB_B.z(), by_hand, 0.15 * by_hand);
}

TEST(MultirotorPlant, RollsAndPitchesInTheRightSense) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  const VehicleState begin = plant.start({});
  Actuators left = holding(p, begin), back = left;
  for (std::size_t k = 0; k < 4; ++k) {
    left[k] -= std::copysign(0.02, p.rotors[k].position.y());
    back[k] -= std::copysign(0.02, p.rotors[k].position.x());
  }
  EXPECT_GT(fly(plant, begin, left, {}, 0.2).w_NB_B.x(), 0.1);   // right side down
  EXPECT_LT(fly(plant, begin, back, {}, 0.2).w_NB_B.y(), -0.1);  // nose down
}

TEST(MultirotorPlant, OneDeadRotorOfSixCanBeHeld) {
  const MultirotorParameters p = hexarotor();
  const MultirotorPlant plant(p);
  VehicleState s = plant.start({});
  const Actuators hover = holding(p, s);
  s.faults.dead = 1;
  VehicleState uncorrected = fly(plant, s, hover, {}, 0.5);
  EXPECT_LT(uncorrected.actuators[0], 0.01 * s.actuators[0]);
  EXPECT_LT(uncorrected.w_NB_B.y(), -0.3);  // the front rotor is missing: nose down
  // The opposite rotor off as well, the other four at 6/4 of the thrust: it holds.
  s.actuators[0] = s.actuators[3] = 0;
  Actuators four = hover;
  four[3] = 0;
  for (const std::size_t k : {1u, 2u, 4u, 5u}) {
    four[k] *= std::sqrt(1.5);
    s.actuators[k] *= std::sqrt(1.5);
  }
  s = fly(plant, s, four, {}, 0.5);
  EXPECT_LT(s.v_N.norm(), 1e-6);
  EXPECT_LT(s.w_NB_B.norm(), 1e-6);
}

TEST(MultirotorPlant, AStuckRotorKeepsItsSpeed) {
  const MultirotorPlant plant{MultirotorParameters{}};
  VehicleState s = plant.start({});
  s.faults.stuck = 2;
  const double speed = s.actuators[1];
  s = fly(plant, s, {}, {}, 0.5);
  EXPECT_EQ(s.actuators[1], speed);
  EXPECT_LT(s.actuators[0], 0.01);
}

TEST(MultirotorPlant, ConvergesWithTheFourthPower) {
  const MultirotorPlant plant{MultirotorParameters{}};
  Actuators throttles;
  throttles.channel = {0.7, 0.62, 0.66, 0.68};
  Air air;
  air.wind_N = {3, 2, 0};
  air.rates_B = {0.1, 0.05, -0.1};
  const auto error = [&](double dt) {
    const VehicleState exact = fly(plant, tumbling(), throttles, air, 0.64, 0.0005);
    const VehicleState s = fly(plant, tumbling(), throttles, air, 0.64, dt);
    return (s.p_N - exact.p_N).norm() + (s.w_NB_B - exact.w_NB_B).norm() +
           s.q_NB.angularDistance(exact.q_NB);
  };
  const double coarse = error(0.02), fine = error(0.01), finest = error(0.005);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.4);
  EXPECT_NEAR(std::log2(fine / finest), 4, 0.4);
  EXPECT_LT(fine, 1e-5);
}

TEST(MultirotorPlant, HeadingChangesNothing) {
  const MultirotorPlant plant{MultirotorParameters{}};
  Actuators throttles;
  throttles.channel = {0.7, 0.62, 0.66, 0.68};
  Air air;
  air.wind_N = {3, 2, 0.5};
  const VehicleState reference = fly(plant, tumbling(), throttles, air, 1);
  for (const double turn : {0.5, 2.0, -3.0}) {
    const Quat q = geo::from_euler({0, 0, turn});
    VehicleState s = tumbling();
    s.v_N = q * s.v_N;
    s.q_NB = q * s.q_NB;
    Air turned = air;
    turned.wind_N = q * air.wind_N;
    s = fly(plant, s, throttles, turned, 1);
    EXPECT_LT((s.p_N - q * reference.p_N).norm(), 1e-11);
    EXPECT_LT((s.w_NB_B - reference.w_NB_B).norm(), 1e-11);
  }
}

TEST(MultirotorPlant, AirRatesTurnIt) {
  const MultirotorPlant plant{MultirotorParameters{}};
  const VehicleState begin = plant.start({});
  const Actuators hover = holding(MultirotorParameters{}, begin);
  Air air;
  air.rates_B = {0.5, 0, 0};
  const double roll_rate = fly(plant, begin, hover, air, 0.2).w_NB_B.x();
  EXPECT_GT(roll_rate, 0.05);
  EXPECT_LT(roll_rate, 0.5);
}

TEST(MultirotorPlant, StaysFiniteFromAnyTumble) {
  const MultirotorPlant plant{MultirotorParameters{}};
  RandomStream random(7, 0, Purpose::kTest);
  const auto any = [&](double max) { return (2 * random.uniform() - 1) * max; };
  for (int run = 0; run < 200; ++run) {
    VehicleState s;
    s.v_N = {any(100), any(100), any(100)};
    s.q_NB = geo::exp_so3({any(3), any(3), any(3)});
    s.w_NB_B = {any(30), any(30), any(30)};
    for (std::size_t k = 0; k < 4; ++k) s.actuators[k] = 390 + any(390);
    Air air;
    air.wind_N = {any(30), any(30), any(10)};
    for (int i = 0; i < 500; ++i) {
      Actuators throttles;
      for (std::size_t k = 0; k < 4; ++k) throttles[k] = 0.5 + any(1);
      if (run % 10 == 0) throttles[0] = std::numeric_limits<double>::quiet_NaN();
      plant.step(s, throttles, air, kStep);
    }
    EXPECT_TRUE(s.p_N.allFinite() && s.v_N.allFinite() && s.w_NB_B.allFinite()) << run;
    EXPECT_NEAR(s.q_NB.norm(), 1, 1e-12);
    EXPECT_LT(s.v_N.norm(), 200) << run;
    EXPECT_LT(s.w_NB_B.norm(), 100) << run;
  }
}

// Step by step with the ground under it, as the simulation does.
Contact step_on_ground(const Plant& plant, VehicleState& s, const Actuators& throttles,
                       double ground) {
  plant.step(s, throttles, {}, kStep);
  return -s.p_N.z() < ground ? plant.touch(s, ground, kStep) : Contact::kRests;
}

TEST(MultirotorPlant, StandsLiftsOffAndLands) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  VehicleState s = plant.start({{5, 6, -100}, 1, Vec3::Zero(), true});
  for (int i = 0; i < 100; ++i)
    ASSERT_EQ(step_on_ground(plant, s, {}, 100), Contact::kRests);
  EXPECT_TRUE(s.on_ground);
  EXPECT_EQ(s.p_N, Vec3(5, 6, -100));
  Actuators throttles;
  throttles.channel.fill(0.72);  // hovering takes 0.667
  for (int i = 0; i < 200; ++i)
    ASSERT_EQ(step_on_ground(plant, s, throttles, 100), Contact::kRests);
  EXPECT_FALSE(s.on_ground);
  EXPECT_LT(s.p_N.z(), -101);
  throttles.channel.fill(0.645);
  bool landed = false;
  for (int i = 0; i < 2000 && !landed; ++i) {
    ASSERT_EQ(step_on_ground(plant, s, throttles, 100), Contact::kRests);
    landed = s.on_ground;
  }
  ASSERT_TRUE(landed);
  throttles.channel.fill(0);
  for (int i = 0; i < 200; ++i) step_on_ground(plant, s, throttles, 100);
  EXPECT_TRUE(s.on_ground);
  EXPECT_EQ(s.v_N, Vec3(0, 0, 0));
  EXPECT_EQ(s.p_N, Vec3(5, 6, -100));
  EXPECT_NEAR(geo::yaw(s.q_NB), 1, 1e-9);
}

TEST(MultirotorPlant, FallingOnTheGroundBreaksIt) {
  const MultirotorPlant plant{MultirotorParameters{}};
  VehicleState s = plant.start({{0, 0, -110}, 0, Vec3::Zero(), false});
  Contact contact = Contact::kRests;
  for (int i = 0; i < 500 && contact == Contact::kRests; ++i)
    contact = step_on_ground(plant, s, {}, 100);
  EXPECT_EQ(contact, Contact::kCrash);
}

TEST(MultirotorParameters, ErrorsNameTheirKeys) {
  EXPECT_TRUE(errors(MultirotorParameters{}).empty());
  EXPECT_TRUE(errors(hexarotor()).empty());
  MultirotorParameters p;
  p.mass = -1;
  p.inertia.zz = 1;
  p.rotors[2].spin = 0.5;
  p.battery.cells = 0;
  const auto found = errors(p);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].key, "mass");
  EXPECT_EQ(found[1].key, "inertia");
  EXPECT_EQ(found[2].key, "rotors[2].spin");
  EXPECT_EQ(found[3].key, "battery.cells");
}

TEST(MultirotorParameters, WhatCannotFlyIsRefused) {
  const auto only_error = [](const MultirotorParameters& p) {
    const auto found = errors(p);
    return found.size() == 1 ? found[0].key : "";
  };
  MultirotorParameters p;
  p.fastest_rotor = 500;
  EXPECT_EQ(only_error(p), "fastest_rotor");
  p = {};
  p.fastest = 60;
  EXPECT_EQ(only_error(p), "fastest");
  p = {};
  p.torque_factor = 1e-7;
  EXPECT_EQ(only_error(p), "torque_factor");
  p = {};
  for (RotorPlace& rotor : p.rotors) rotor.spin = 1;  // cannot turn about down
  EXPECT_EQ(only_error(p), "rotors");
  p = {};
  for (RotorPlace& rotor : p.rotors) rotor.position.x() += 0.2;
  EXPECT_EQ(only_error(p), "rotors");
}

TEST(MultirotorPlant, DescribesWhatItsAutopilotMustKnow) {
  const MultirotorParameters p;
  const MultirotorPlant plant(p);
  const auto airframe = std::get<MultirotorAirframe>(plant.airframe());
  ASSERT_EQ(airframe.rotors.size(), 4u);
  // Thrust and torque at half throttle, as given and as flown.
  VehicleState s = plant.start({});
  s.actuators.fill(p.fastest_rotor / 2);
  s.actuators[1] = s.actuators[2] = s.actuators[3] = 0;
  Actuators throttles;
  throttles[0] = 0.5;
  const VehicleState begin = s;
  plant.step(s, throttles, {}, 1e-6);
  const Vec3 acceleration = (s.v_N - begin.v_N) / 1e-6 - Vec3(0, 0, kGravity);
  const double thrust = airframe.thrust_max * std::pow(0.5, airframe.thrust_exponent);
  EXPECT_NEAR(acceleration.z() * p.mass, -thrust, 1e-4 * thrust);
  const Vec3 moment = airframe.inertia.cwiseProduct(s.w_NB_B - begin.w_NB_B) / 1e-6;
  const RotorPlace& rotor = airframe.rotors[0];
  EXPECT_NEAR(moment.x(), -rotor.position.y() * thrust, 1e-4 * thrust);
  EXPECT_NEAR(moment.y(), rotor.position.x() * thrust, 1e-4 * thrust);
  EXPECT_NEAR(moment.z(), rotor.spin * airframe.torque_ratio * thrust, 1e-4 * thrust);
}

}  // namespace
}  // namespace skein::asset::multirotor_test
