// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/pointwise/particle_rule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::perimeter::particle_test {
namespace {

model::ControlPoint prior_point() {
  model::ControlPoint point;
  point.mean << 500, 0, 3, 0;
  point.covariance.diagonal() << 10816, 10816, 0.003364, 0.003364;
  return point;
}

HalfSpace half_space(const model::ControlPoint& point, const Vec2& aircraft,
                     model::Side side) {
  return {aircraft, 1, side, look_at(point, aircraft, 1)};
}

TEST(ParticleRule, AgreesWithTheExactMomentsOfOneReading) {
  for (model::Side side : {model::Side::kAbove, model::Side::kBelow}) {
    const model::ControlPoint prior = prior_point();
    model::ControlPoint want = prior, got = prior;
    const Vec2 aircraft(450, 20);
    half_space_update(want, aircraft, 1, side);
    const int count = 40000;
    ParticleRule rule(count, 0, 5);
    rule.start(std::span(&got, 1));
    rule.half_space(0, got, half_space(got, aircraft, side));
    // Five standard errors of a mean with 104 m and a third of the particles.
    EXPECT_LT((got.position() - want.position()).norm(),
              5 * 104 / std::sqrt(count / 3.0));
    EXPECT_NEAR(got.covariance(0, 0) / want.covariance(0, 0), 1, 0.06);
    EXPECT_NEAR(got.covariance(1, 1) / want.covariance(1, 1), 1, 0.06);
  }
}

TEST(ParticleRule, ManyReadingsFromOnePlaceCountLittleMoreThanOne) {
  model::ControlPoint got = prior_point(), gaussian = got;
  ParticleRule rule(2000, 0, 5);
  rule.start(std::span(&got, 1));
  const Vec2 aircraft(396, 0);  // one sigma inside
  for (int k = 0; k < 100; ++k) {
    rule.half_space(0, got, half_space(got, aircraft, model::Side::kAbove));
    half_space_update(gaussian, aircraft, 1, model::Side::kAbove);
  }
  const double sd = std::sqrt(got.covariance(0, 0)) / 104;
  // True 0.794; kernel smoothing blurs the cut a little each time particles are renewed.
  EXPECT_NEAR(sd, 0.794, 0.08);
  EXPECT_LT(std::sqrt(gaussian.covariance(0, 0)) / 104, 0.5);
}

TEST(ParticleRule, LearnsARateFromTwoCrossings) {
  model::ControlPoint got = prior_point(), want = got;
  got.covariance(2, 2) = want.covariance(2, 2) = 1;
  ParticleRule rule(2000, 0, 9);
  rule.start(std::span(&got, 1));
  rule.crossing(0, got, {540, 0}, 6);
  locate_point(want, {540, 0}, 6);
  rule.predict(std::span(&got, 1), 200, 1e-6);
  predict_point(want, 200, 1e-6);
  rule.crossing(0, got, {1000, 0}, 6);  // 2.3 m/s
  locate_point(want, {1000, 0}, 6);
  EXPECT_NEAR(got.mean(2), want.mean(2), 0.02);
  EXPECT_NEAR(got.mean(0), want.mean(0), 2);
}

TEST(ParticleRule, SurvivesAConflictFarOut) {
  model::ControlPoint got = prior_point();
  ParticleRule rule(100, 0, 5);
  rule.start(std::span(&got, 1));
  const Vec2 aircraft(500 + 2.9 * 104, 0);
  rule.half_space(0, got, half_space(got, aircraft, model::Side::kBelow));
  EXPECT_GT(got.mean(0), aircraft.x());
  EXPECT_GT(got.covariance(0, 0), 100);
}

TEST(ParticleRule, DiscountsAReadingThatMayBeFalse) {
  model::ControlPoint got = prior_point();
  ParticleRule rule(4000, 0.05, 5);
  rule.start(std::span(&got, 1));
  const Vec2 aircraft(500 + 2.5 * 104, 0);
  rule.half_space(0, got, half_space(got, aircraft, model::Side::kBelow));
  const model::MixtureMoments want =
      model::uncertain_half_line(260, std::sqrt(10817.0), 0, 0.05, 0.95);
  // The mixture is wide: 104/sqrt(4000) = 1.6 m a standard error, and more for its tail.
  EXPECT_NEAR(got.mean(0) - aircraft.x(), -want.mean, 12);
}

TEST(ParticleRule, IsAFunctionOfTheSeedAlone) {
  model::ControlPoint a = prior_point(), b = a, c = a;
  ParticleRule rule(100, 0, 5), other(100, 0, 6);
  rule.start(std::span(&a, 1));
  other.start(std::span(&c, 1));
  const auto copy = rule.clone();
  const HalfSpace seen = half_space(a, {450, 20}, model::Side::kBelow);
  rule.half_space(0, a, seen);
  copy->half_space(0, b, seen);
  other.half_space(0, c, seen);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_NE(a.mean, c.mean);
}

}  // namespace
}  // namespace skein::perimeter::particle_test
