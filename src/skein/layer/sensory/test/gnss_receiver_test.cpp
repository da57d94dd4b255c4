// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/gnss_receiver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/sensory/test/test_world.h"

namespace skein::sensory::gnss_receiver_test {
namespace {

// A receiver with one source only, and that in one range metre of position per axis.
GnssReceiverOptions only_source(double GnssReceiverOptions::*source, double sd) {
  GnssReceiverOptions options;
  options.clock_sd = options.orbit_sd = options.ionosphere_sd = 0;
  options.troposphere_sd = options.multipath_sd = options.noise_sd = 0;
  options.velocity_sd = 0;
  options.latency = 0;
  options.hdop = std::sqrt(2.0);
  options.vdop = 1;
  options.*source = sd;
  return options;
}

std::vector<double> errors(const GnssReceiverOptions& options, std::uint64_t seed,
                           int n) {
  const TestWorld world;
  GnssReceiver sensor(options, seed, {1});
  std::vector<double> all;
  for (const auto& fix :
       only<GnssFix>(world.run(sensor, Time::from_seconds(1 / options.rate_hz), n)))
    for (int axis = 0; axis < 3; ++axis) all.push_back(fix.p_N[axis]);
  return all;
}

TEST(GnssReceiver, EachSourceHasItsSpreadAndCorrelation) {
  struct Case {
    double GnssReceiverOptions::*source;
    double sd, correlation_time;
  };
  for (const Case& c : {Case{&GnssReceiverOptions::clock_sd, 2, 1800},
                        Case{&GnssReceiverOptions::orbit_sd, 2.5, 3600},
                        Case{&GnssReceiverOptions::ionosphere_sd, 5, 1800},
                        Case{&GnssReceiverOptions::troposphere_sd, 0.5, 3600},
                        Case{&GnssReceiverOptions::multipath_sd, 1, 30},
                        Case{&GnssReceiverOptions::noise_sd, 0.3, 1}}) {
    GnssReceiverOptions options = only_source(c.source, c.sd);
    options.rate_hz = 10 / c.correlation_time;  // ten samples a correlation time
    const int n = 60000;
    const auto e = errors(options, 7, n);
    double variance = 0, lag = 0;
    for (std::size_t i = 0; i < e.size(); ++i) {
      variance += e[i] * e[i] / static_cast<double>(e.size());
      if (i >= 30) lag += e[i] * e[i - 30] / static_cast<double>(e.size());
    }
    // 3 axes x n/10 correlation times: relative standard error of the variance
    // sqrt(2/18,000) = 1.1 %; bound at 4.5 of them.
    EXPECT_NEAR(variance, c.sd * c.sd, 0.05 * c.sd * c.sd) << c.correlation_time;
    EXPECT_NEAR(lag, std::exp(-1) * c.sd * c.sd, 0.05 * c.sd * c.sd)
        << c.correlation_time;
  }
}

TEST(GnssReceiver, StatesItsErrorHonestly) {
  // First fixes of many receivers are independent, and in the steady state.
  const TestWorld world;
  for (const GnssKind kind :
       {GnssKind::kSingle, GnssKind::kDifferential, GnssKind::kRtk}) {
    std::vector<double> north, down, velocity;
    GnssFix fix;
    for (std::uint32_t unit = 0; unit < 4000; ++unit) {
      GnssReceiver sensor({.latency = 0, .kind = kind}, 3, {unit});
      fix = only<GnssFix>(world.run(sensor, ms(200), 1)).at(0);
      north.push_back(fix.p_N.x());
      down.push_back(fix.p_N.z());
      velocity.push_back(fix.v_N.y());
    }
    EXPECT_EQ(fix.kind, kind);
    const auto squared = [](double x) { return x * x; };
    // 4.5 standard errors of 2.2 %.
    EXPECT_NEAR(moments(north).variance / squared(fix.position_sd), 1, 0.1);
    EXPECT_NEAR(moments(down).variance / squared(fix.altitude_sd), 1, 0.1);
    EXPECT_NEAR(moments(velocity).variance / squared(fix.velocity_sd), 1, 0.1);
    if (kind == GnssKind::kSingle) {
      // sqrt(2^2 + 2.5^2 + 5^2 + 0.5^2 + 1^2 + 0.3^2) = 6.05 m of range.
      EXPECT_NEAR(fix.position_sd, 6.05 * 0.9 / std::sqrt(2.0), 0.01);
    } else if (kind == GnssKind::kDifferential) {
      EXPECT_NEAR(fix.position_sd, 0.7, 0.1);
    } else {
      EXPECT_LT(fix.position_sd, 0.02);  // a centimetre
      EXPECT_LT(fix.altitude_sd, 0.03);
    }
  }
}

TEST(GnssReceiver, StatisticsDoNotDependOnTheRate) {
  for (const double rate : {1.0, 5.0, 10.0}) {
    GnssReceiverOptions options = only_source(&GnssReceiverOptions::noise_sd, 0.3);
    options.rate_hz = rate;
    const auto e = errors(options, 9, static_cast<int>(10000 * rate));
    double variance = 0, lag_1s = 0;
    const auto back = static_cast<std::size_t>(3 * rate);
    for (std::size_t i = 0; i < e.size(); ++i) {
      variance += e[i] * e[i] / static_cast<double>(e.size());
      if (i >= back) lag_1s += e[i] * e[i - back] / static_cast<double>(e.size());
    }
    // 10,000 correlation times x 3 axes: standard error 0.8 %; bound at 4.5.
    EXPECT_NEAR(variance, 0.09, 0.09 * 0.037) << rate;
    EXPECT_NEAR(lag_1s, 0.09 * std::exp(-1), 0.09 * 0.037) << rate;
  }
}

TEST(GnssReceiver, FixArrivesAfterItsLatencyWithItsOwnTime) {
  TestWorld world;
  GnssReceiverOptions options = only_source(&GnssReceiverOptions::noise_sd, 0);
  options.latency = 0.13;
  options.rate_hz = 10;
  GnssReceiver sensor(options, 1, {1});
  int seen = 0;
  for (int i = 0; i < 500; ++i) {
    const Time now = ms(10 * i);
    world.vehicle.p_N.x() = 20 * now.seconds();
    std::vector<SensorSample> out;
    sensor.sample(world.at(now), out);
    for (const auto& fix : only<GnssFix>(out)) {
      EXPECT_EQ(now, fix.time + ms(130));
      EXPECT_EQ(fix.time, ms(100 * seen));
      EXPECT_NEAR(fix.p_N.x(), 20 * fix.time.seconds(), 1e-12);
      ++seen;
    }
  }
  EXPECT_EQ(seen, 49);  // measured at 0, 0.1, ..., 4.8 s; out by 4.99 s
}

TEST(GnssReceiver, LosesItsFixOnCommandAndReacquires) {
  const TestWorld world;
  GnssReceiver sensor({.latency = 0,
                       .outages = {.spans = {{20, 25}, {10, 12}, {11, 14}}},
                       .reacquisition = 3},
                      1, {1});
  const auto fixes = only<GnssFix>(world.run(sensor, ms(10), 4000));
  for (const auto& fix : fixes) {
    const double t = fix.time.seconds();
    EXPECT_FALSE((t >= 10 && t < 17) || (t >= 20 && t < 28)) << t;
  }
  EXPECT_EQ(fixes.size(), 200U - 35 - 40);
}

TEST(GnssReceiver, OutagesDoNotChangeTheErrors) {
  const TestWorld world;
  GnssReceiver plain({}, 1, {1});
  GnssReceiver lossy({.outages = {.spans = {{3, 4}}, .per_hour = 100}}, 1, {1});
  const auto all = only<GnssFix>(world.run(plain, ms(100), 2000));
  const auto some = only<GnssFix>(world.run(lossy, ms(100), 2000));
  ASSERT_LT(some.size(), all.size());
  std::size_t i = 0;
  for (const auto& fix : some) {
    while (all.at(i).time < fix.time) ++i;
    EXPECT_EQ(all[i].p_N, fix.p_N);
  }
}

}  // namespace
}  // namespace skein::sensory::gnss_receiver_test
