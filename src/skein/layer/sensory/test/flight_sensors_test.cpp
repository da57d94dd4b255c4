// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "skein/data/vehicle/air.h"
#include "skein/layer/sensory/airspeed_sensor.h"
#include "skein/layer/sensory/barometer.h"
#include "skein/layer/sensory/ideal_navigation.h"
#include "skein/layer/sensory/imu_sensor.h"
#include "skein/layer/sensory/magnetometer.h"
#include "skein/layer/sensory/power_sensor.h"
#include "skein/layer/sensory/test/test_world.h"

namespace skein::sensory::flight_sensors_test {
namespace {

const ImuOptions kPerfectImu{.gyro_noise = 0,
                             .gyro_bias_sd = 0,
                             .gyro_bias_walk = 0,
                             .gyro_scale_sd = 0,
                             .accelerometer_noise = 0,
                             .accelerometer_bias_sd = 0,
                             .accelerometer_bias_walk = 0,
                             .accelerometer_scale_sd = 0};

// A tumbling, accelerating vehicle; positions by their closed form.
VehicleState tumbling(double t) {
  VehicleState s;
  s.q_NB = geo::exp_so3({1.5 * std::sin(t), 0.7 * t, -2 * std::cos(0.8 * t)});
  s.v_N = {10 + 3 * std::sin(2 * t), -4 * std::cos(t), 2 * t};
  s.p_N = {10 * t - 1.5 * std::cos(2 * t), -4 * std::sin(t), t * t};
  return s;
}

TEST(ImuSensor, MechanisationGivesTheTruthBack) {
  TestWorld world;
  for (const int rate : {20, 100}) {
    ImuSensor sensor(
        [&] {
          ImuOptions o = kPerfectImu;
          o.rate_hz = rate;
          return o;
        }(),
        1, {1});
    const VehicleState start = tumbling(0);
    Quat q = start.q_NB;
    Vec3 v = start.v_N, p = start.p_N;
    std::vector<SensorSample> out;
    const int n = 10 * rate;
    for (int i = 0; i <= n; ++i) {
      const Time now = Time::from_ns(1'000'000'000LL / rate * i);
      world.vehicle = tumbling(now.seconds());
      out.clear();
      sensor.sample(world.at(now), out);
      ASSERT_EQ(out.size(), i == 0 ? 0U : 1U);  // the first call begins the interval
      if (i == 0) continue;
      const auto& imu = std::get<ImuSample>(out[0]);
      EXPECT_EQ(imu.time, now);
      EXPECT_NEAR(imu.interval, 1.0 / rate, 1e-15);
      const double dt = imu.interval;
      const Quat q_mid = q * geo::exp_so3(imu.w_NB_B * (dt / 2));
      const Vec3 v_next = v + (q_mid * imu.f_B + Vec3(0, 0, kGravity)) * dt;
      q = q * geo::exp_so3(imu.w_NB_B * dt);
      p += (v + v_next) / 2 * dt;
      v = v_next;
    }
    // Rounding of 1,000 steps.
    EXPECT_LT(q.angularDistance(world.vehicle.q_NB), 1e-11) << rate;
    EXPECT_LT((v - world.vehicle.v_N).norm(), 1e-10) << rate;
    // Trapezoid: dt^2/12 times the change of acceleration (at most 16 m/s^2).
    EXPECT_LT((p - world.vehicle.p_N).norm(), 16.0 / 12 / rate / rate) << rate;
  }
}

TEST(ImuSensor, AtRestFeelsOnlyGravity) {
  TestWorld world;
  world.vehicle.q_NB = geo::from_euler({0.3, -0.2, 2});
  ImuSensor sensor(kPerfectImu, 1, {1});
  const auto out = only<ImuSample>(world.run(sensor, ms(10), 3));
  ASSERT_EQ(out.size(), 2U);
  EXPECT_LT(out[1].w_NB_B.norm(), 1e-14);
  EXPECT_LT((out[1].f_B + kGravity * geo::down_in_body(world.vehicle.q_NB)).norm(),
            1e-13);
}

TEST(ImuSensor, NoiseHasItsDensityAtAnyRate) {
  const TestWorld world;  // at rest, level
  for (const int rate : {25, 100}) {
    ImuOptions options = kPerfectImu;
    options.rate_hz = rate;
    options.gyro_noise = 2e-3;
    options.accelerometer_noise = 5e-3;
    ImuSensor sensor(options, 3, {1});
    const int n = 40000;
    std::vector<double> w, f;
    for (const auto& s : only<ImuSample>(world.run(sensor, ms(1000 / rate), n))) {
      w.push_back(s.w_NB_B.y());
      f.push_back(s.f_B.z() + kGravity);
    }
    // Variance of n samples: relative standard error sqrt(2/n) = 0.7 %; bound at 4.5.
    EXPECT_NEAR(moments(w).variance, 4e-6 * rate, 4e-6 * rate * 0.032);
    EXPECT_NEAR(moments(f).variance, 25e-6 * rate, 25e-6 * rate * 0.032);
  }
}

TEST(ImuSensor, ConstantErrorsAreThoseOfTheOptions) {
  // At rest only the bias shows in w, bias and scale in f; over 4,000 units.
  TestWorld world;
  ImuOptions options = kPerfectImu;
  options.gyro_bias_sd = 0.01;
  options.accelerometer_bias_sd = 0.2;
  options.accelerometer_scale_sd = 0.03;
  std::vector<double> w, f_level, f_down;
  for (std::uint32_t unit = 0; unit < 4000; ++unit) {
    ImuSensor sensor(options, 5, {unit});
    const auto out = only<ImuSample>(world.run(sensor, ms(10), 2));
    w.push_back(out[0].w_NB_B.x());
    f_level.push_back(out[0].f_B.x());
    f_down.push_back(out[0].f_B.z() + kGravity);
  }
  // Relative standard error of the variance 2.2 %; bounds at 4.5 of them.
  EXPECT_NEAR(moments(w).variance, 1e-4, 1e-4 * 0.1);
  EXPECT_NEAR(moments(f_level).variance, 0.04, 0.04 * 0.1);
  const double down = 0.04 + std::pow(0.03 * kGravity, 2);
  EXPECT_NEAR(moments(f_down).variance, down, down * 0.1);
}

TEST(ImuSensor, BiasesWalk) {
  const TestWorld world;
  ImuOptions options = kPerfectImu;
  options.gyro_bias_walk = 1e-3;
  options.accelerometer_bias_walk = 2e-2;
  for (const int rate : {10, 50}) {
    options.rate_hz = rate;
    std::vector<double> w, f;
    for (std::uint32_t unit = 0; unit < 2000; ++unit) {
      ImuSensor sensor(options, 6, {unit});
      const auto out = only<ImuSample>(world.run(sensor, ms(1000 / rate), 16 * rate + 2));
      w.push_back(out.back().w_NB_B.z());
      f.push_back(out.back().f_B.y());
    }
    // 16 s: variance 16 walk^2; relative standard error 3.2 %, bound at 4.5 of them.
    EXPECT_NEAR(moments(w).variance, 16e-6, 16e-6 * 0.145) << rate;
    EXPECT_NEAR(moments(f).variance, 64e-4, 64e-4 * 0.145) << rate;
  }
}

TEST(ImuSensor, Saturates) {
  TestWorld world;
  ImuOptions options = kPerfectImu;
  options.gyro_range = 2;
  options.accelerometer_range = 5;
  ImuSensor sensor(options, 1, {1});
  std::vector<SensorSample> out;
  for (int i = 0; i < 2; ++i) {
    world.vehicle.q_NB = geo::exp_so3({0, 0.05 * i, 0});
    sensor.sample(world.at(ms(10 * i)), out);
  }
  const auto& imu = std::get<ImuSample>(out.at(0));
  EXPECT_EQ(imu.w_NB_B.y(), 2);
  EXPECT_EQ(imu.f_B.z(), -5);
}

TEST(Barometer, HasBiasDriftAndNoise) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -500};
  const BarometerOptions options{
      .rate_hz = 2, .bias_sd = 2, .drift_sd = 1.5, .drift_time = 5, .noise_sd = 0.5};
  // Across units: all variances add.
  std::vector<double> first;
  for (std::uint32_t unit = 0; unit < 4000; ++unit) {
    Barometer sensor(options, 1, {unit});
    first.push_back(
        only<BarometerSample>(world.run(sensor, ms(10), 1)).at(0).altitude_msl - 500);
  }
  const double all = 4 + 2.25 + 0.25;
  EXPECT_NEAR(moments(first).mean, 0, 4.5 * std::sqrt(all / 4000));
  EXPECT_NEAR(moments(first).variance, all, all * 0.1);  // 4.5 standard errors of 2.2 %
  // Within one unit: drift and noise, and the drift's correlation.
  const int n = 100000;
  Barometer sensor(options, 2, {1});
  std::vector<double> z;
  for (const auto& s : only<BarometerSample>(world.run(sensor, ms(500), n)))
    z.push_back(s.altitude_msl);
  const Moments m = moments(z);
  double lag5s = 0;
  for (std::size_t i = 10; i < z.size(); ++i)
    lag5s += (z[i] - m.mean) * (z[i - 10] - m.mean) / n;
  // n / 10 independent stretches of the drift: relative standard error 1.4 %.
  EXPECT_NEAR(m.variance, 2.5, 2.5 * 0.06);
  EXPECT_NEAR(lag5s, 2.25 * std::exp(-1.0), 2.25 * 0.06);
}

TEST(Magnetometer, SeesTheFieldInTheBodyFrame) {
  TestWorld world;
  world.vehicle.q_NB = geo::from_euler({0, 0, geo::kPi / 2});  // heading east
  Magnetometer perfect(
      {.declination = 0.1, .inclination = 1, .hard_iron_sd = 0, .noise_sd = 0}, 1, {1});
  const Vec3 m = only<MagnetometerSample>(world.run(perfect, ms(40), 1)).at(0).m_B;
  EXPECT_NEAR(m.x(), std::cos(1) * std::sin(0.1), 1e-15);  // its east part is ahead
  EXPECT_NEAR(m.y(), -std::cos(1) * std::cos(0.1), 1e-15);
  EXPECT_NEAR(m.z(), std::sin(1), 1e-15);
}

TEST(Magnetometer, HardIronStaysAndNoiseDoesNot) {
  const TestWorld world;
  const MagnetometerOptions options{.hard_iron_sd = 0.05, .noise_sd = 0.01};
  const Vec3 field = magnetic_field_N(options.declination, options.inclination);
  std::vector<double> iron, noise;
  for (std::uint32_t unit = 0; unit < 2000; ++unit) {
    Magnetometer sensor(options, 1, {unit});
    const auto out = only<MagnetometerSample>(world.run(sensor, ms(40), 2));
    iron.push_back(((out[0].m_B + out[1].m_B) / 2 - field).z());
    noise.push_back((out[0].m_B - out[1].m_B).x());
  }
  // Relative standard error of a variance of 2,000: 3.2 %, bound at 4.5 of them.
  EXPECT_NEAR(moments(iron).variance, 25e-4 + 0.5e-4, 25.5e-4 * 0.145);
  EXPECT_NEAR(moments(noise).variance, 2e-4, 2e-4 * 0.145);
}

TEST(AirspeedSensor, HasBiasScaleNoiseAndFloor) {
  TestWorld world;
  const AirspeedOptions options{.bias_sd = 0.4, .scale_sd = 0.05, .noise_sd = 0.2};
  std::vector<double> slow, fast;
  for (std::uint32_t unit = 0; unit < 4000; ++unit) {
    for (const double speed : {10.0, 30.0}) {
      AirspeedSensor sensor(options, 1, {unit});
      world.vehicle.airspeed = speed;
      const double said =
          only<AirspeedSample>(world.run(sensor, ms(10), 1)).at(0).airspeed;
      (speed < 20 ? slow : fast).push_back(said - speed);
    }
  }
  const auto expected = [](double v) { return 0.16 + 0.04 + std::pow(0.05 * v, 2); };
  // 4.5 standard errors of 2.2 %.
  EXPECT_NEAR(moments(slow).variance, expected(10), 0.1 * expected(10));
  EXPECT_NEAR(moments(fast).variance, expected(30), 0.1 * expected(30));
  world.vehicle.airspeed = 2;
  AirspeedSensor floor({.bias_sd = 0, .noise_sd = 0, .floor = 3}, 1, {1});
  EXPECT_EQ(only<AirspeedSample>(world.run(floor, ms(10), 1)).at(0).airspeed, 0);
}

TEST(IdealNavigation, GivesTheTruth) {
  TestWorld world;
  world.vehicle = tumbling(3);
  world.vehicle.w_NB_B = {1, 2, 3};
  world.air.wind_N = {4, 5, 6};
  IdealNavigation sensor({});
  const auto out = only<TruthSample>(world.run(sensor, ms(10), 2));
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(out[1].time, ms(10));
  EXPECT_EQ(out[1].p_N, world.vehicle.p_N);
  EXPECT_EQ(out[1].v_N, world.vehicle.v_N);
  EXPECT_EQ(out[1].q_NB.coeffs(), world.vehicle.q_NB.coeffs());
  EXPECT_EQ(out[1].w_NB_B, world.vehicle.w_NB_B);
  EXPECT_EQ(out[1].wind_N, world.air.wind_N);
}

TEST(PowerSensor, CountsChargeWithErrorsThatGrow) {
  TestWorld world;
  std::vector<double> late;
  for (std::uint32_t unit = 0; unit < 2000; ++unit) {
    PowerSensor sensor({.gain_sd = 0.02, .drift_sd = 0.03}, 1, {unit});
    std::vector<SensorSample> out;
    world.vehicle.energy.charge = 0.9;
    sensor.sample(world.at(Time()), out);
    EXPECT_EQ(std::get<PowerSample>(out[0]).charge, 0.9);  // it starts right
    world.vehicle.energy.charge = 0.4;
    sensor.sample(world.at(Time::from_seconds(1800)), out);
    late.push_back(std::get<PowerSample>(out[1]).charge - 0.4);
  }
  const double expected = std::pow(0.5 * 0.02, 2) + std::pow(0.5 * 0.03, 2);
  EXPECT_NEAR(moments(late).mean, 0, 4.5 * std::sqrt(expected / 2000));
  EXPECT_NEAR(moments(late).variance, expected, 0.145 * expected);  // 4.5 of 3.2 %
}

TEST(PowerSensor, MeasuresVoltageAndCurrent) {
  TestWorld world;
  world.vehicle.energy = {.charge = 1, .voltage = 12, .power = 120};
  PowerSensor sensor({.voltage_sd = 0.05, .current_sd = 0.3}, 1, {1});
  std::vector<double> voltage, current;
  for (const auto& s : only<PowerSample>(world.run(sensor, ms(200), 20000))) {
    voltage.push_back(s.voltage);
    current.push_back(s.current);
  }
  // 4.5 standard errors: of the means sd/141, of the variances 1 %.
  EXPECT_NEAR(moments(voltage).mean, 12, 4.5 * 0.05 / 141);
  EXPECT_NEAR(moments(voltage).variance, 25e-4, 25e-4 * 0.045);
  EXPECT_NEAR(moments(current).mean, 10, 4.5 * 0.3 / 141);
  EXPECT_NEAR(moments(current).variance, 0.09, 0.09 * 0.045);
  world.vehicle.energy = {.charge = 1, .voltage = 0, .power = 0};  // not modelled
  PowerSensor none({}, 1, {1});
  const auto out = only<PowerSample>(world.run(none, ms(200), 1));
  EXPECT_EQ(out.at(0).voltage, 0);
  EXPECT_EQ(out.at(0).current, 0);
}

TEST(PowerSensor, KnowsStandingMotorsAfterItsDelay) {
  TestWorld world;
  PowerSensor sensor({.rate_hz = 100, .motor_delay = 0.2, .motors = 0b1000}, 1, {1});
  std::vector<SensorSample> out;
  for (int i = 0; i < 200; ++i) {
    if (i == 50) world.vehicle.faults.dead = 0b1001;  // channel 0 is a surface
    if (i == 120) world.vehicle.faults.dead = 0;
    sensor.sample(world.at(ms(10 * i)), out);
  }
  const auto samples = only<PowerSample>(out);
  ASSERT_EQ(samples.size(), 200U);
  for (int i = 0; i < 200; ++i)
    EXPECT_EQ(samples[static_cast<std::size_t>(i)].motors_standing,
              i >= 70 && i < 140 ? 0b1000 : 0)
        << i;
  world.vehicle.faults.battery = true;
  out.clear();
  for (int i = 200; i < 230; ++i) sensor.sample(world.at(ms(10 * i)), out);
  EXPECT_EQ(std::get<PowerSample>(out.back()).motors_standing, 0b1000);
}

}  // namespace
}  // namespace skein::sensory::flight_sensors_test
