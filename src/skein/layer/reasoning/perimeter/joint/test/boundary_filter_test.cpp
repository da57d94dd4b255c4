// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/boundary_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "skein/base/random.h"
#include "skein/geo/vec.h"
#include "skein/model/probability/truncated_normal.h"

namespace skein::perimeter::boundary_filter_test {
namespace {

constexpr int kKnots = 24;

BoundaryHypothesis plain() {
  BoundaryHypothesis hypothesis;
  hypothesis.radius = {100, 5};
  hypothesis.rate = {0.1, 6};
  hypothesis.mean_rate_sd = 0.2;
  hypothesis.wind_sd = 0;
  return hypothesis;
}

Eigen::MatrixXd full(BoundaryFilter& filter) {
  filter.settle();
  return Eigen::MatrixXd(filter.covariance().selfadjointView<Eigen::Lower>());
}

// The radius at a bearing as a dense row.
Eigen::RowVectorXd radius_row(double bearing) {
  const PeriodicSpline::Tap tap = PeriodicSpline(kKnots).at(bearing);
  Eigen::RowVectorXd h = Eigen::RowVectorXd::Zero(2 * kKnots + 2);
  for (std::size_t i = 0; i < 4; ++i) h[2 + tap.index[i]] = tap.value[i];
  return h;
}

TEST(BoundaryFilter, PriorHasTheStatedMoments) {
  BoundaryHypothesis windy = plain();
  windy.wind_sd = 1;
  const BoundaryFilter filter(PerimeterPrior{}, windy, kKnots, 2);
  for (const double bearing : {0.0, 1.0, 4.4}) {
    const BoundaryFilter::Local local = filter.at(bearing);
    EXPECT_NEAR(local.radius, 500, 1e-9);
    EXPECT_NEAR(local.growth, 3, 1e-9);
    // Between knots the spline loses a little of its highest harmonics.
    EXPECT_NEAR(std::sqrt(local.variance), 100, 1);
    EXPECT_NEAR(std::sqrt(local.growth_variance), std::sqrt(0.01 + 0.04 + 1), 0.01);
  }
}

TEST(BoundaryFilter, PredictionEqualsTheDenseKalmanFilterInStillAir) {
  BoundaryFilter filter(PerimeterPrior{}, plain(), kKnots, 2);
  const Eigen::MatrixXd before = full(filter);
  const double dt = 13;
  const Eigen::Index n = before.rows();
  Eigen::MatrixXd F = Eigen::MatrixXd::Identity(n, n);
  F.block(2, 2 + kKnots, kKnots, kKnots).diagonal().setConstant(dt);
  const Eigen::MatrixXd expected = F * before * F.transpose();
  filter.predict(dt);
  // The same sums in another order: 1e-12 of the largest entry (10^4).
  EXPECT_LT((full(filter) - expected).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(filter.at(2).radius, 500 + 3 * dt, 1e-9);
}

TEST(BoundaryFilter, KnownWindMovesAndBendsTheBoundaryAsThePointsMove) {
  PerimeterPrior prior;
  prior.wind = {1.5, 0};
  BoundaryFilter filter(prior, plain(), kKnots, 2);
  Vec2 point = 500 * geo::unit(1.2);
  for (int step = 0; step < 6000; ++step) {
    point += 0.1 * (3 * point.normalized() + prior.wind);
    if (step % 10 == 9) filter.predict(1);
  }
  // Heun's steps and 24 knots; the point has come from bearing 1.2 to 0.7 and 2,700 m
  // out.
  EXPECT_NEAR(filter.at(geo::bearing(point)).radius, point.norm(), 4);
}

TEST(BoundaryFilter, BoundEqualsTheDenseHalfSpaceUpdate) {
  BoundaryFilter filter(PerimeterPrior{}, plain(), kKnots, 2);
  filter.predict(20);
  const Eigen::MatrixXd P = full(filter);
  const Eigen::VectorXd x = filter.mean();
  const Eigen::RowVectorXd h = radius_row(0.7);
  const double sd = 3, S = (h * P * h.transpose())(0) + sd * sd;
  const auto cut =
      model::truncate_one_sided(h * x, std::sqrt(S), 600, model::Side::kAbove);
  const Eigen::VectorXd K = P * h.transpose() / S;
  const Eigen::VectorXd x_after = x + K * (cut.mean - h * x);
  const Eigen::MatrixXd P_after = P - K * (S - cut.variance) * K.transpose();

  PolarReading reading{
      .bearing = 0.7, .distance = 600, .inside = true, .position_sd = sd};
  EXPECT_NEAR(filter.probability(reading),
              1 - model::normal_cdf((600 - h * x) / std::sqrt(S)), 1e-12);
  filter.observe(0, reading, 0);
  EXPECT_LT((filter.mean() - x_after).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((full(filter) - P_after).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(BoundaryFilter, CrossingLeavesTheBoundaryOnTheTrack) {
  BoundaryFilter filter(PerimeterPrior{}, plain(), kKnots, 2);
  filter.predict(10);
  PolarReading crossing{.bearing = 2,
                        .distance = 610,
                        .inside = true,
                        .position_sd = 0.5,
                        .crossing = true,
                        .radial = -20,
                        .tangential = 0,
                        .period = 1};
  filter.observe(0, crossing, 0);
  const BoundaryFilter::Local local = filter.at(2);
  // The fire met the aircraft at 23 m/s: it is between 600 and 623 m now.
  EXPECT_NEAR(local.radius, 611.5, 0.5);
  EXPECT_NEAR(std::sqrt(local.variance), 23 / std::sqrt(12.0), 0.3);
}

TEST(BoundaryFilter, TheSameBoundCountsOnce) {
  BoundaryFilter filter(PerimeterPrior{}, plain(), kKnots, 2);
  PolarReading reading{.bearing = 0.7, .distance = 450, .inside = true, .position_sd = 0};
  filter.observe(0, reading, 0);
  const BoundaryFilter::Local once = filter.at(0.7);
  for (int i = 0; i < 1000; ++i) filter.observe(0, reading, 0);
  const BoundaryFilter::Local often = filter.at(0.7);
  // The exact posterior of one bound at -0.5 sigma; counted again and again it would
  // shrink to a third.
  EXPECT_NEAR(often.radius, once.radius, 1e-3);
  EXPECT_NEAR(often.variance, once.variance, 1e-3 * once.variance);
}

TEST(BoundaryFilter, ATighterBoundReplacesALooserOne) {
  BoundaryFilter both(PerimeterPrior{}, plain(), kKnots, 2), tight(both);
  PolarReading reading{.bearing = 0.7, .distance = 400, .inside = true, .position_sd = 0};
  both.observe(0, reading, 0);
  reading.distance = 480;
  both.observe(0, reading, 0);
  tight.observe(0, reading, 0);
  // Only the tighter bound matters, so both routes end at its exact moments.
  EXPECT_NEAR(both.at(0.7).radius, tight.at(0.7).radius, 1e-6);
  EXPECT_LT((full(both) - full(tight)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(BoundaryFilter, CovarianceStaysPositiveThroughWindAndManyReadings) {
  PerimeterPrior prior;
  prior.wind = {0.5, -0.8};
  BoundaryHypothesis windy = plain();
  windy.wind_sd = 1;
  BoundaryFilter filter(prior, windy, kKnots, 2);
  RandomStream random(3, 0, Purpose::kTest);
  for (int second = 0; second < 1500; ++second) {
    filter.predict(1);
    for (int slot = 0; slot < 2; ++slot) {
      PolarReading reading;
      reading.bearing = random.uniform(-3, 3);
      const BoundaryFilter::Local local = filter.at(reading.bearing);
      reading.distance = local.radius + 2 * std::sqrt(local.variance) * random.normal();
      reading.inside = random.uniform() < 0.5;
      reading.position_sd = 1;
      reading.crossing = random.uniform() < 0.1;
      reading.radial = reading.inside ? -12 : 12;
      reading.tangential = 16;
      reading.period = 1;
      filter.observe(slot, reading, 1e-3);
    }
  }
  const Eigen::MatrixXd P = full(filter);
  ASSERT_TRUE(P.allFinite());
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P).eigenvalues();
  // Rounding of the largest entries (10^5) may reach below zero by some 10^-11 each.
  EXPECT_GT(values.minCoeff(), -1e-8 * values.maxCoeff());
}

TEST(BoundaryFilter, WideningMakesAFarBoundaryPossible) {
  BoundaryFilter filter(PerimeterPrior{}, plain(), kKnots, 2);
  filter.widen(1, 2000, 3);
  EXPECT_NEAR(std::sqrt(filter.at(1).variance), 500, 25);
  // Half a turn away nothing has changed.
  EXPECT_NEAR(std::sqrt(filter.at(1 + geo::kPi).variance), 100, 1);
}

}  // namespace
}  // namespace skein::perimeter::boundary_filter_test
