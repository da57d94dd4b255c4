// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/traffic/track_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <random>

namespace skein::reasoning::track_filter_test {
namespace {

// An aircraft whose velocity wanders as the filter takes it to.
struct Wanderer {
  std::mt19937_64 random;
  std::normal_distribution<double> normal{};
  Vec3 p_N{500, -800, -200}, v_N{20, 15, 0};

  double draw() { return normal(random); }
  Vec3 draw3() { return {draw(), draw(), draw()}; }
  void move(double t) {
    constexpr int kSteps = 20;
    const double h = t / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      p_N += h * v_N;
      v_N += std::sqrt(h) * Vec3(1.5 * draw(), 1.5 * draw(), 0.7 * draw());
    }
  }
};

TrafficMeasurement broadcast(Wanderer& of, double t, double sd, double v_sd) {
  TrafficMeasurement m;
  m.time = Time::from_seconds(t);
  m.p_N = of.p_N + sd * of.draw3();
  m.p_covariance = sd * sd * Mat3::Identity();
  if (v_sd > 0) {
    m.v_N = of.v_N + v_sd * of.draw3();
    m.v_sd = v_sd;
  }
  return m;
}

// Squared errors are what the covariances say, on average: three for three dimensions.
void expect_consistent(double v_sd) {
  double of_place = 0, of_velocity = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Wanderer aircraft{std::mt19937_64(seed)};
    TrackFilter filter(broadcast(aircraft, 0, 20, v_sd));
    for (int k = 1; k < 40; ++k) {
      aircraft.move(1);
      filter.update(broadcast(aircraft, k, 20, v_sd));
      if (k < 10) continue;
      const TrafficState x = filter.at(filter.time());
      const Vec3 p = aircraft.p_N - x.p_N, v = aircraft.v_N - x.v_N;
      of_place += p.dot(x.pp.llt().solve(p));
      of_velocity += v.dot(x.vv.llt().solve(v));
      ++count;
    }
  }
  EXPECT_NEAR(of_place / count, 3, 0.3);
  EXPECT_NEAR(of_velocity / count, 3, 0.3);
}

TEST(TrackFilter, KnowsHowFarItIsOff) {
  expect_consistent(0.7);
  expect_consistent(0);
}

TEST(TrackFilter, CarriesOnWithGrowingErrors) {
  Wanderer aircraft{std::mt19937_64(1)};
  double squares = 0, expected = 0;
  for (int run = 0; run < 500; ++run) {
    TrackFilter filter(broadcast(aircraft, 0, 10, 0.7));
    aircraft.move(5);
    const TrafficState x = filter.at(Time::from_seconds(5));
    squares += (aircraft.p_N - x.p_N).squaredNorm();
    expected += x.pp.trace();
  }
  EXPECT_NEAR(squares / expected, 1, 0.15);
  const TrackFilter filter(broadcast(aircraft, 0, 10, 0.7));
  EXPECT_GT(filter.at(Time::from_seconds(9)).horizontal_sd(),
            filter.at(Time::from_seconds(3)).horizontal_sd());
  EXPECT_NEAR(filter.at(Time()).vertical_sd(), 10, 1e-9);
}

TEST(TrackFilter, TakesALateMeasurementForWhatItIs) {
  Wanderer still{std::mt19937_64(3)};
  still.v_N = {30, 0, 0};
  const auto at = [&](double t) {
    TrafficMeasurement m;
    m.time = Time::from_seconds(t);
    m.p_N = Vec3(30 * t, 0, -100);
    m.p_covariance = 25 * Mat3::Identity();
    m.v_N = Vec3(30, 0, 0);
    m.v_sd = 0.7;
    return m;
  };
  TrackFilter filter(at(0));
  filter.update(at(2));
  EXPECT_LT(filter.distance2(at(1.4)), 1e-9);
  filter.update(at(1.4));
  EXPECT_EQ(filter.time(), Time::from_seconds(2));
  EXPECT_NEAR((filter.at(Time::from_seconds(2)).p_N - Vec3(60, 0, -100)).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace skein::reasoning::track_filter_test
