// SPDX-License-Identifier: Apache-2.0
#include "skein/model/probability/half_space_update.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "skein/base/random.h"

namespace skein::model::half_space_update_test {
namespace {

ControlPoint point_at(double north, double east) {
  ControlPoint point;
  point.mean << north, east, 3, 0;
  point.covariance.diagonal() << 10816, 10816, 0.003364, 0.003364;
  return point;
}

TEST(HalfSpaceUpdate, ReproducesAReferenceCase) {
  ControlPoint point = point_at(500, 0);
  point.covariance(0, 2) = point.covariance(2, 0) = 3.016;
  point.covariance(1, 3) = point.covariance(3, 1) = 3.016;
  const Moments range = half_space_update(point, {560, 80}, 1, side_of(true, false));
  // Printed with 12 digits.
  EXPECT_NEAR(range.mean, -55.4230359384, 1e-9);
  EXPECT_NEAR(range.variance, 2202.98349353, 1e-7);
  EXPECT_NEAR(point.mean(0), 593.24520052, 1e-8);
  EXPECT_NEAR(point.mean(1), 124.326934027, 1e-8);
  EXPECT_NEAR(point.mean(2), 3.02600106553, 1e-10);
  EXPECT_NEAR(point.mean(3), 0.0346680873729, 1e-12);
  EXPECT_NEAR(point.covariance(0, 0), 7715.52739641, 1e-7);
  EXPECT_NEAR(point.covariance(0, 3), -1.15273981415, 1e-10);
  EXPECT_NEAR(point.covariance(2, 3), -0.000321437063562, 1e-14);
}

TEST(HalfSpaceUpdate, AConflictBesideAPointMovesItAlongTheEdge) {
  // 60 m beside the point, an aircraft sees fire: the point moves on to (593, 124).
  ControlPoint point = point_at(500, 0);
  half_space_update(point, {560, 80}, 1, Side::kBelow);
  EXPECT_NEAR(point.mean(0), 593, 0.5);
  EXPECT_NEAR(point.mean(1), 124, 0.5);
}

// The same by the rotations of algorithm 1, with its misprints corrected.
ControlPoint by_rotation(const ControlPoint& point, const Vec2& aircraft, double noise,
                         Side side) {
  const Vec2 d = point.position() - aircraft;
  const double mu = d.norm();
  const Vec2 a = d / mu, b = geo::turned_right(a);
  Eigen::Matrix4d T = Eigen::Matrix4d::Zero();
  for (int block : {0, 2}) {
    T.block<1, 2>(block, block) = a.transpose();
    T.block<1, 2>(block + 1, block) = b.transpose();
  }
  const Eigen::Matrix4d P = T * point.covariance * T.transpose();
  const double S = P(0, 0) + noise;
  const TruncatedNormal cut =
      truncate_normal(mu, std::sqrt(S),
                      side == Side::kAbove ? Interval{.lower = 0} : Interval{.upper = 0});
  const Eigen::Vector4d K = P.col(0) / S;
  ControlPoint result;
  result.mean = point.mean + T.transpose() * K * (cut.mean - mu);
  result.covariance = T.transpose() * (P - K * (S - cut.variance) * K.transpose()) * T;
  return result;
}

TEST(HalfSpaceUpdate, EqualsAlgorithmOneWithItsRotations) {
  RandomStream random(7, 0, Purpose::kTest);
  for (int k = 0; k < 200; ++k) {
    Eigen::Matrix4d root;
    for (int i = 0; i < 16; ++i) root(i) = random.normal();
    ControlPoint point;
    for (int i = 0; i < 4; ++i) point.mean(i) = 3 * random.normal();
    point.covariance = root * root.transpose() + 0.1 * Eigen::Matrix4d::Identity();
    const Vec2 aircraft(random.normal(), random.normal());
    const Side side = random.uniform() < 0.5 ? Side::kAbove : Side::kBelow;
    const ControlPoint want = by_rotation(point, aircraft, 0.3, side);
    half_space_update(point, aircraft, 0.3, side);
    EXPECT_LT((point.mean - want.mean).norm(), 1e-10);
    EXPECT_LT((point.covariance - want.covariance).norm(), 1e-10);
  }
}

// (2.23), (2.24): the first two moments of the state given only that the noisy range lies
// on one side, by sampling state and noise.
TEST(HalfSpaceUpdate, GivesTheExactMomentsOfTheState) {
  ControlPoint prior;
  prior.mean << 1, 0.5, -0.4, 0.2;
  Eigen::Matrix4d root;
  root << 1, 0, 0, 0, 0.3, 0.8, 0, 0, 0.5, -0.2, 0.6, 0, -0.1, 0.4, 0.2, 0.5;
  prior.covariance = root * root.transpose();
  const Vec2 aircraft(0, 0);
  const double noise = 0.25;
  const LineOfSight seen = look_at(prior, aircraft, noise);
  for (Side side : {Side::kAbove, Side::kBelow}) {
    RandomStream random(11, 0, Purpose::kTest);
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    Eigen::Matrix4d squares = Eigen::Matrix4d::Zero();
    double n = 0;
    for (int k = 0; k < 400000; ++k) {
      Eigen::Vector4d g;
      for (int i = 0; i < 4; ++i) g(i) = random.normal();
      const Eigen::Vector4d x = prior.mean + root * g;
      const double z =
          seen.direction.dot(x.head<2>()) + std::sqrt(noise) * random.normal();
      if ((z > 0) != (side == Side::kAbove)) continue;
      ++n;
      sum += x;
      squares += x * x.transpose();
    }
    const Eigen::Vector4d mean = sum / n;
    const Eigen::Matrix4d covariance = squares / n - mean * mean.transpose();
    ControlPoint point = prior;
    half_space_update(point, aircraft, noise, side);
    // Five standard errors of a mean and a variance of order 1.
    EXPECT_LT((point.mean - mean).cwiseAbs().maxCoeff(), 5 / std::sqrt(n));
    EXPECT_LT((point.covariance - covariance).cwiseAbs().maxCoeff(), 8 / std::sqrt(n));
  }
}

// An early bug: one constraint counted again and again.
TEST(HalfSpaceUpdate, RepeatedOnOneBoundShrinksFarBelowTheTruth) {
  double mean = 0, variance = 1;
  double sd_1 = 0, sd_10 = 0;
  double mean_1 = 0;
  for (int k = 1; k <= 1000; ++k) {
    const Moments cut = truncate_one_sided(mean, std::sqrt(variance), -1, Side::kAbove);
    mean = cut.mean;
    variance = cut.variance;
    if (k == 1) sd_1 = std::sqrt(variance), mean_1 = mean;
    if (k == 10) sd_10 = std::sqrt(variance);
  }
  // Printed with three digits.
  EXPECT_NEAR(sd_1, 0.794, 5e-4);
  EXPECT_NEAR(mean_1, 0.288, 5e-4);
  EXPECT_NEAR(sd_10, 0.553, 5e-4);
  EXPECT_NEAR(std::sqrt(variance), 0.369, 5e-4);
  EXPECT_NEAR(mean, 0.623, 5e-4);
}

TEST(HalfSpaceUpdate, LeavesAPointUnderTheAircraftAlone) {
  ControlPoint point = point_at(500, 0);
  half_space_update(point, {500, 0}, 1, Side::kBelow);
  EXPECT_EQ(point.mean, point_at(500, 0).mean);
  EXPECT_EQ(point.covariance, point_at(500, 0).covariance);
}

TEST(LocatePoint, EqualsTheMatrixForm) {
  ControlPoint point = point_at(500, 20);
  predict_point(point, 200, 0.01);
  point.covariance(0, 1) = point.covariance(1, 0) = 4000;
  Eigen::Matrix<double, 2, 4> H = Eigen::Matrix<double, 2, 4>::Zero();
  H(0, 0) = H(1, 1) = 1;
  const Eigen::Matrix2d S =
      H * point.covariance * H.transpose() + 36 * Eigen::Matrix2d::Identity();
  const Eigen::Matrix<double, 4, 2> K = point.covariance * H.transpose() * S.inverse();
  const Vec2 where(1200, -30);
  const Eigen::Vector4d mean = point.mean + K * (where - H * point.mean);
  const Eigen::Matrix4d covariance = point.covariance - K * S * K.transpose();
  locate_point(point, where, 6);
  EXPECT_LT((point.mean - mean).norm(), 1e-9);
  EXPECT_LT((point.covariance - covariance).norm(), 1e-8);
}

TEST(PredictPoint, EqualsTheMatrixForm) {
  ControlPoint point = point_at(500, 20);
  point.covariance(0, 3) = point.covariance(3, 0) = 2;
  const double dt = 1.5, q = 0.02;
  Eigen::Matrix4d F = Eigen::Matrix4d::Identity(), Q = Eigen::Matrix4d::Zero();
  F(0, 2) = F(1, 3) = dt;
  for (int i : {0, 1}) {
    Q(i, i) = q * dt * dt * dt / 3;
    Q(i, i + 2) = Q(i + 2, i) = q * dt * dt / 2;
    Q(i + 2, i + 2) = q * dt;
  }
  const Eigen::Vector4d mean = F * point.mean;
  const Eigen::Matrix4d covariance = F * point.covariance * F.transpose() + Q;
  predict_point(point, dt, q);
  EXPECT_LT((point.mean - mean).norm(), 1e-12);
  EXPECT_LT((point.covariance - covariance).norm(), 1e-10);
}

TEST(PredictPoint, InTwoStepsEqualsOne) {
  ControlPoint once = point_at(500, 20), twice = once;
  predict_point(once, 3, 0.01);
  predict_point(twice, 1, 0.01);
  predict_point(twice, 2, 0.01);
  EXPECT_LT((once.covariance - twice.covariance).norm(), 1e-10);
}

TEST(HalfSpaceUpdate, KeepsTheCovarianceAValidOneUnderAnyReadings) {
  const bool holds = rc::check("random readings and times", [] {
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    RandomStream random(seed, 0, Purpose::kTest);
    ControlPoint point = point_at(500, 0);
    for (int k = 0; k < 300; ++k) {
      predict_point(point, random.uniform(), 1e-6);
      const double before = point.covariance.trace();
      const Vec2 aircraft =
          point.position() +
          random.uniform(0, 300) * geo::unit(random.uniform(0, 2 * geo::kPi));
      half_space_update(point, aircraft, 1,
                        random.uniform() < 0.3 ? Side::kBelow : Side::kAbove);
      RC_ASSERT(point.mean.allFinite());
      RC_ASSERT(point.covariance.trace() <= before * (1 + 1e-12));
      const double asymmetry =
          (point.covariance - point.covariance.transpose()).cwiseAbs().maxCoeff();
      RC_ASSERT(asymmetry <= 1e-12 * before);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(point.covariance);
      RC_ASSERT(eigen.eigenvalues().minCoeff() >= -1e-12 * before);
    }
  });
  EXPECT_TRUE(holds);
}

}  // namespace
}  // namespace skein::model::half_space_update_test
