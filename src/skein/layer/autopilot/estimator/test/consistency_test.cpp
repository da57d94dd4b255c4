// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <vector>

#include "skein/layer/autopilot/estimator/test/synthetic_flight.h"

namespace skein::autopilot::consistency_test {
namespace {

using testing::FlightPlan;
using testing::nees;
using testing::SyntheticFlight;

constexpr int kRuns = 50;
constexpr int kSeconds = 200;

// Mean NEES over the runs, each second, of position, velocity and attitude and of all.
struct Consistency {
  std::vector<double> moving = std::vector<double>(kSeconds, 0.0);
  std::vector<double> all = std::vector<double>(kSeconds, 0.0);
  double worst_position_sd = 0;
};

Consistency fly(const FlightPlan& plan) {
  const EstimatorOptions options;
  Consistency out;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    SyntheticFlight flight(options, plan, 100 + run);
    FlightEstimator estimator(options, flight.start({2, 3, 0.3, 0.02, 0.05, 2}));
    for (std::size_t t = 0; t < kSeconds; ++t) {
      for (int k = 0; k < 100; ++k)
        flight.step([&](const auto& sample) { estimator.add(sample); });
      out.moving[t] +=
          nees(flight.truth(), estimator, error::kAttitude, error::kSize) / kRuns;
      out.all[t] += nees(flight.truth(), estimator, 0, error::kSize) / kRuns;
      out.worst_position_sd =
          std::max(out.worst_position_sd, estimator.accuracy().position);
    }
  }
  return out;
}

double mean(const std::vector<double>& v) {
  double sum = 0;
  for (double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

// Share of the seconds in which the mean over the runs is in the 95 % band of
// chi-square(runs n) / runs, which is normal for so many degrees.
double in_band(const std::vector<double>& v, double n) {
  const double half = 1.96 * std::sqrt(2 * n / kRuns);
  double count = 0;
  for (double x : v) count += std::abs(x - n) < half ? 1 : 0;
  return count / static_cast<double>(v.size());
}

// The mean over time of the mean over the runs is in the band of a single second. Seconds
// are far from independent (satellite errors last for half an hour), so that by chance a
// stretch of them may be outside: a quarter is let pass.
void expect_consistent(const Consistency& c, double all_high) {
  EXPECT_NEAR(mean(c.moving), 9, 1.96 * std::sqrt(18.0 / kRuns));
  EXPECT_GT(in_band(c.moving, 9), 0.75);
  EXPECT_LT(mean(c.all), all_high);
}

// 95 % band of the mean of all 28.
const double kAllHigh = 28 + 1.96 * std::sqrt(56.0 / kRuns);

TEST(EstimatorConsistency, StraightAndLevel) {
  FlightPlan plan;
  plan.manoeuvres = false;
  expect_consistent(fly(plan), kAllHigh);
}

TEST(EstimatorConsistency, ThroughTurnsAndClimbs) {
  expect_consistent(fly({}), kAllHigh);
}

TEST(EstimatorConsistency, ThroughHalfAMinuteWithoutSatellites) {
  FlightPlan plan;
  plan.outage_from = 100;
  plan.outage_until = 130;
  const Consistency c = fly(plan);
  expect_consistent(c, kAllHigh);
  EXPECT_GT(c.worst_position_sd, 4) << "the variance grows without fixes";
}

TEST(EstimatorConsistency, InWindWithTurbulence) {
  FlightPlan plan;
  plan.wind = {4.8, 6.4};
  plan.gust_sd = 2;
  expect_consistent(fly(plan), kAllHigh);
}

TEST(EstimatorConsistency, InWindWithTurbulenceAndWithoutSatellites) {
  FlightPlan plan;
  plan.wind = {4.8, 6.4};
  plan.gust_sd = 2;
  plan.outage_from = 100;
  plan.outage_until = 130;
  expect_consistent(fly(plan), kAllHigh);
}

}  // namespace
}  // namespace skein::autopilot::consistency_test
