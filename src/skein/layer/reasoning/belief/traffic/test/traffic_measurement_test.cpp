// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/traffic/traffic_measurement.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace skein::reasoning::traffic_measurement_test {
namespace {

TEST(TrafficMeasurement, OfPolarNumbersIsWhereTheyPoint) {
  const Vec3 own(100, 200, -50);
  const auto m = from_polar(Time::from_seconds(3), TrafficSource::kRadar, own,
                            {1000, 10, geo::radians(90), 0.02, geo::radians(30), 0.03});
  EXPECT_NEAR((m.p_N - Vec3(100, 200 + 866.03, -550)).norm(), 0, 0.01);
  EXPECT_EQ(m.time, Time::from_seconds(3));
  EXPECT_FALSE(m.v_N);
  EXPECT_TRUE(is_sound(m));
}

// The covariance is that of places measured with such errors.
TEST(TrafficMeasurement, OfPolarNumbersHasTheirErrors) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const double range = 800, bearing = 2, elevation = 0.4;
  const auto m = from_polar({}, TrafficSource::kRadar, Vec3::Zero(),
                            {range, 20, bearing, 0.03, elevation, 0.05});
  Mat3 sum = Mat3::Zero();
  constexpr int kCount = 20'000;
  for (int k = 0; k < kCount; ++k) {
    const double r = range + 20 * normal(random), b = bearing + 0.03 * normal(random);
    const double e = elevation + 0.05 * normal(random);
    const Vec3 p(r * std::cos(e) * std::cos(b), r * std::cos(e) * std::sin(b),
                 -r * std::sin(e));
    sum += (p - m.p_N) * (p - m.p_N).transpose();
  }
  EXPECT_LT((sum / kCount - m.p_covariance).norm(), 0.05 * m.p_covariance.norm());
}

TEST(TrafficMeasurement, OfAPassiveDetectorMayKnowNoHeight) {
  const Vec3 own(0, 0, -100);
  const auto with = from_coarse({}, own, 2000, 400, 0, 0.35, 300, 60);
  EXPECT_NEAR(with.p_N.x(), 2000, 1e-9);
  EXPECT_NEAR(with.p_N.z(), -400, 1e-9);
  EXPECT_NEAR(with.p_covariance(2, 2), 3600, 1e-9);
  EXPECT_NEAR(with.p_covariance(1, 1), 700 * 700, 1);
  const auto without = from_coarse({}, own, 2000, 400, 0, 0.35, std::nullopt, 0);
  EXPECT_NEAR(without.p_N.z(), -100, 1e-9);
  EXPECT_GT(without.p_covariance(2, 2), 200 * 200);
}

TEST(TrafficMeasurement, IsUnsoundWithoutNumbersOrErrors) {
  TrafficMeasurement m;
  EXPECT_TRUE(is_sound(m));
  m.p_N.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_sound(m));
  m = {};
  m.p_covariance(1, 1) = 0;
  EXPECT_FALSE(is_sound(m));
  m = {};
  m.v_N = Vec3(1, 2, 3);
  EXPECT_FALSE(is_sound(m)) << "a velocity without errors";
  m.v_sd = 0.7;
  EXPECT_TRUE(is_sound(m));
}

}  // namespace
}  // namespace skein::reasoning::traffic_measurement_test
