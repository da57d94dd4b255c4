// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

#include "skein/base/check.h"
#include "skein/base/random.h"
#include "skein/geo/polygon.h"
#include "skein/layer/reasoning/perimeter/pointwise/gaussian_rule.h"
#include "skein/layer/reasoning/perimeter/pointwise/pointwise_kinds.h"

namespace skein::perimeter::pointwise_test {
namespace {

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

PointwiseEstimator make(const std::string& name, const PointwiseOptions& options = {},
                        const PerimeterPrior& prior = {}) {
  for (const PointwiseKind& kind : pointwise_kinds())
    if (kind.name == name) {
      PointwiseOptions used = options;
      used.use_crossings |= kind.needs_crossings;
      return PointwiseEstimator(used, prior, kind.make_rule(used, 1));
    }
  throw std::invalid_argument(name);
}

FireReading reading(double seconds, const Vec2& point, bool inside, double sd = 0) {
  return {at(seconds), EntityId{0}, point, sd, inside};
}

std::vector<Vec2> positions(const BoundaryEstimate& boundary) {
  std::vector<Vec2> ring;
  for (const BoundaryPoint& point : boundary.rings.at(0)) ring.push_back(point.position);
  return ring;
}

TEST(PointwiseEstimator, StartsFromThePrior) {
  PerimeterPrior prior;
  prior.origin = {100, -50};
  prior.wind = {0.5, 0};
  const PointwiseEstimator estimator = make("qkf", {}, prior);
  const BoundaryEstimate boundary = estimator.boundary();
  ASSERT_EQ(boundary.rings.size(), 1u);
  ASSERT_EQ(boundary.rings[0].size(), 60u);
  EXPECT_GT(geo::signed_area(positions(boundary)), 0) << "growing bearing";
  for (const BoundaryPoint& point : boundary.rings[0]) {
    const Vec2 radial = (point.position - prior.origin).normalized();
    EXPECT_NEAR((point.position - prior.origin).norm(), prior.radius, 1e-9);
    EXPECT_NEAR(point.normal.dot(radial), 1, 1e-12);
    EXPECT_NEAR(point.sigma, prior.radius_sd, 1e-9);
    EXPECT_NEAR(point.sigma_growth, 0, 1e-12) << "position and rate start independent";
    EXPECT_NEAR(point.rate, prior.rate + prior.wind.dot(radial), 1e-12);
  }
}

TEST(PointwiseEstimator, PredictsGrowthOfPositionAndUncertainty) {
  PointwiseOptions options;
  options.process_noise = 0;
  PerimeterPrior prior;
  PointwiseEstimator estimator = make("qkf", options, prior);
  estimator.predict(at(1000));
  const BoundaryPoint point = estimator.boundary().rings[0][17];
  EXPECT_NEAR(point.position.norm(), prior.radius + 3000, 1e-9);
  EXPECT_NEAR(point.sigma, std::hypot(prior.radius_sd, 1000 * prior.rate_sd), 1e-9);
  EXPECT_THROW(estimator.predict(at(999)), Bug);
}

TEST(PointwiseEstimator, SigmaGrowthIsTheDerivativeOfSigma) {
  PointwiseEstimator estimator = make("qkf");
  estimator.predict(at(300));
  estimator.observe(reading(300, {1500, 200}, true));
  const BoundaryEstimate before = estimator.boundary();
  estimator.predict(at(300.01));
  for (std::size_t i = 0; i < 60; ++i) {
    const BoundaryPoint& point = before.rings[0][i];
    // Along the same normal; the points' rates turn the edge a little.
    const Eigen::Matrix2d P = estimator.points()[i].covariance.topLeftCorner<2, 2>();
    const double later = std::sqrt(point.normal.dot(P * point.normal));
    // The second derivative is below 1e-3 m/s^2.
    EXPECT_NEAR(point.sigma_growth, (later - point.sigma) / 0.01, 1e-5) << i;
  }
}

TEST(PointwiseEstimator, MajorAxisIsTheLargestEigenvectorOfThePosition) {
  PointwiseEstimator estimator = make("qkf");
  const auto start = estimator.boundary().rings[0];
  for (const BoundaryPoint& point : start)
    EXPECT_NEAR((point.major_axis - point.sigma * point.normal).norm(), 0,
                1e-9);  // circle
  estimator.observe(reading(0, {560, 80}, true));
  estimator.observe(reading(0, {0, -620}, true));
  const auto ring = estimator.boundary().rings[0];
  int stretched = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Matrix2d P = estimator.points()[i].covariance.topLeftCorner<2, 2>();
    const Vec2 axis = ring[i].major_axis;
    const double longest = axis.squaredNorm();
    // P a = |a|^2 a, and no direction has more.
    EXPECT_LT((P * axis - longest * axis).norm(), 1e-9 * longest * axis.norm());
    EXPECT_GE(2 * longest, P.trace() * (1 - 1e-12));
    if (longest > 1.05 * (P.trace() - longest)) ++stretched;
  }
  EXPECT_GT(stretched, 0);
}

TEST(PointwiseEstimator, AConflictPullsPointsPastTheAircraft) {
  PointwiseEstimator estimator = make("qkf");
  estimator.observe(reading(0, {450, 0}, true));  // inside, as expected
  EXPECT_GT(estimator.points()[0].position().x(), 500);
  PointwiseEstimator conflict = make("qkf");
  conflict.observe(reading(0, {600, 0}, true));  // fire seen 100 m outside
  EXPECT_GT(conflict.points()[0].position().x(), 600);
  EXPECT_LT(conflict.boundary().rings[0][0].sigma, 104);
}

TEST(PointwiseEstimator, OnePointEqualsTheUpdateOfOnePoint) {
  PointwiseOptions options;
  PointwiseEstimator estimator = make("qkf", options);
  model::ControlPoint want = estimator.points()[3];
  const Vec2 aircraft(520, 200);
  model::half_space_update(want, aircraft, 1 + 4, model::Side::kBelow);
  estimator.observe(reading(0, aircraft, true, 2));
  EXPECT_LT((estimator.points()[3].mean - want.mean).norm(), 1e-12);
  EXPECT_LT((estimator.points()[3].covariance - want.covariance).norm(), 1e-9);
}

TEST(PointwiseEstimator, TheGateLeavesFarPointsAlone) {
  PointwiseEstimator estimator = make("qkf");
  const PointwiseEstimator before = make("qkf");
  estimator.observe(reading(0, {600, 0}, true));
  EXPECT_EQ(estimator.points()[30].mean, before.points()[30].mean) << "1100 m away";
  EXPECT_NE(estimator.points()[1].mean, before.points()[1].mean);
  EXPECT_EQ(estimator.health().outliers, 0);
  estimator.observe(reading(0, {2500, 0}, true));
  EXPECT_EQ(estimator.health().outliers, 1) << "a fire 19 sigma outside";
  EXPECT_EQ(estimator.health().observations, 2);
}

TEST(PointwiseEstimator, ACrossingCorrectsTheNearestPoint) {
  Crossing crossing;
  crossing.point = {560, 3};
  crossing.track = {-20, 0};
  crossing.point_sd = 2;
  crossing.entered = true;
  PointwiseEstimator estimator = make("qkf");
  estimator.observe(crossing);
  // Between prior (104 m) and crossing (20/sqrt(12), 2 and 1 m): 36 cm short of it.
  EXPECT_NEAR(estimator.points()[0].position().x(), 560, 0.4);
  const BoundaryPoint point = estimator.boundary().rings[0][0];
  EXPECT_NEAR(point.sigma, std::sqrt(400.0 / 12 + 4 + 1), 0.05);

  PointwiseOptions options;
  options.use_crossings = false;
  PointwiseEstimator plain = make("qkf", options), same = make("qkf", options);
  plain.observe(crossing);
  same.observe(reading(0, {550, 3}, true, 2));
  EXPECT_EQ(plain.points()[0].mean, same.points()[0].mean) << "then the later reading";
}

TEST(PointReset, OnlyCrossingsCountAndRatesStay) {
  PointwiseOptions options;
  options.use_crossings = false;  // the kind needs them all the same
  PointwiseEstimator estimator = make("point-reset", options);
  estimator.predict(at(10));
  const BoundaryEstimate before = estimator.boundary();
  estimator.observe(reading(10, {600, 0}, true));
  EXPECT_EQ(positions(estimator.boundary()), positions(before));
  Crossing crossing;
  crossing.time = at(10);
  crossing.point = {600, 5};
  crossing.track = {10, 0};
  crossing.point_sd = 1;
  estimator.observe(crossing);
  const model::ControlPoint& point = estimator.points()[0];
  EXPECT_EQ(point.position(), Vec2(600, 5));
  EXPECT_EQ(point.velocity(), Vec2(3, 0));
  // sqrt(100/12 + 1 + 1) = 3.2 m is below the floor of 5 m.
  EXPECT_NEAR(estimator.boundary().rings[0][0].sigma, 5, 1e-12);
  EXPECT_EQ(estimator.points()[1].position(), positions(before)[1]);
}

// Contract of the role, for every kind: shape, validity and independence of clones.
TEST(PointwiseKinds, KeepTheContractUnderRandomReadings) {
  for (const PointwiseKind& kind : pointwise_kinds()) {
    const bool holds = rc::check(std::string(kind.name), [&] {
      RandomStream random(*rc::gen::arbitrary<std::uint64_t>(), 0, Purpose::kTest);
      PointwiseOptions options;
      options.control_points = 20;
      options.particles = 40;
      const auto estimator = make_pointwise(kind, options, {}, 3);
      double now = 0;
      std::unique_ptr<PerimeterEstimator> copy;
      for (int k = 0; k < 40; ++k) {
        now += random.uniform(0, 5);
        const Vec2 where = random.uniform(300, 900) * geo::unit(random.uniform(0, 7));
        if (k == 20) copy = estimator->clone();
        estimator->predict(at(now));
        if (random.uniform() < 0.2)
          estimator->observe(Crossing{at(now), EntityId{0}, where, Vec2(20, 0), 2, true});
        else
          estimator->observe(reading(now, where, random.uniform() < 0.5, 2));
      }
      const BoundaryEstimate boundary = estimator->boundary();
      RC_ASSERT(boundary.rings.size() == 1u);
      RC_ASSERT(boundary.time == at(now));
      for (const BoundaryPoint& point : boundary.rings[0]) {
        RC_ASSERT(point.position.allFinite());
        RC_ASSERT(std::abs(point.normal.norm() - 1) < 1e-9);
        RC_ASSERT(point.sigma >= 0 && std::isfinite(point.sigma));
        RC_ASSERT(std::isfinite(point.sigma_growth) && std::isfinite(point.rate));
      }
      const auto* own = dynamic_cast<const PointwiseEstimator*>(estimator.get());
      RC_ASSERT(own != nullptr);
      for (const model::ControlPoint& point : own->points()) {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(point.covariance);
        RC_ASSERT(eigen.eigenvalues().minCoeff() >= -1e-9 * point.covariance.trace());
      }
      RC_ASSERT(copy->boundary().time < boundary.time);
    });
    EXPECT_TRUE(holds) << kind.name;
  }
}

TEST(PointwiseKinds, AgreeWithTheExactOneOnTheSideOfAConflict) {
  for (const char* name : {"qkf", "mle", "map", "ukf", "qkf-a15", "particle"}) {
    PointwiseEstimator estimator = make(name);
    estimator.observe(reading(0, {560, 0}, true));
    EXPECT_GT(estimator.points()[0].position().x(), 530) << name;
    EXPECT_LT(estimator.points()[0].position().x(), 660) << name;
  }
}

TEST(PointwiseKinds, MapLearnsNothingFromWhatItExpected) {
  PointwiseEstimator map = make("map"), qkf = make("qkf");
  for (PointwiseEstimator* estimator : {&map, &qkf})
    estimator->observe(reading(0, {450, 0}, true));
  EXPECT_LT(map.points()[0].position().x() - 500, 2);
  EXPECT_GT(qkf.points()[0].position().x() - 500, 20);
}

// An aircraft that reads every second where it stands shrinks the belief without end,
// though it says the same thing: kept as the thesis has it.
TEST(PointwiseKinds, QkfCountsOneBoundManyTimes) {
  for (double gate : {100.0, 3.0}) {
    PointwiseOptions options;
    options.gate_sigmas = gate;
    PointwiseEstimator estimator = make("qkf", options);
    for (int k = 0; k < 1000; ++k)
      estimator.observe(reading(0, {396, 0}, true));  // one sigma inside
    const double shrunk = estimator.boundary().rings[0][0].sigma / 104;
    // True 0.794. Without a gate as the scalar recursion (0.369; the sensor's 1 m changes
    // it by less than 1 %); the gate ends it where the point has fled 3 of its sigmas.
    if (gate > 3) {
      EXPECT_NEAR(shrunk, 0.369, 0.004);
    } else {
      EXPECT_LT(shrunk, 0.55);
    }
  }
}

TEST(PointwiseEstimator, RefusesOptionsOutOfRange) {
  PointwiseOptions options;
  options.control_points = 7;
  EXPECT_THROW(make("qkf", options), Bug);
  options = {};
  options.sigma_v = 0;
  EXPECT_THROW(make("map", options), Bug);
  options = {};
  options.particles = 10;
  EXPECT_THROW(make("particle", options), Bug);
}

}  // namespace
}  // namespace skein::perimeter::pointwise_test
