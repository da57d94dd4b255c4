// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/ensemble/ensemble_estimator.h"

#include <gtest/gtest.h>

#include "skein/geo/polygon.h"
#include "skein/layer/reasoning/perimeter/test/weaving.h"

namespace skein::perimeter::ensemble_estimator_test {
namespace {

constexpr EntityId kAircraft{1};

PerimeterPrior prior() {
  PerimeterPrior p;
  p.radius = 200;
  p.radius_sd = 40;
  p.rate = 0.2;
  p.rate_sd = 0.1;
  p.wind_sd = 0.02;
  return p;
}

Crossing crossing(double time, const Vec2& point, const Vec2& track, bool entered) {
  return {Time::from_seconds(time), kAircraft, point, track, 2, entered};
}

FireReading reading(double time, const Vec2& point, bool inside) {
  return {Time::from_seconds(time), kAircraft, point, 2, inside};
}

double spread_at(const EnsembleEstimator& e, const Vec2& p) {
  return std::sqrt(e.ensemble().distance(p).variance);
}

TEST(Ensemble, ACrossingPullsTheBoundaryAndTeachesTheNeighbourhood) {
  EnsembleEstimator e(prior(), {});
  const Vec2 here(230, 0), near(225, 60), far(-200, 0);
  const double near_before = spread_at(e, near), far_before = spread_at(e, far);
  e.observe(crossing(0, here, Vec2(-15, 15), true));
  // A crossing is good to track/sqrt(12), GNSS and a third of a cell: about 7 m.
  EXPECT_NEAR(e.ensemble().distance(here).mean, 0, 4);
  EXPECT_LT(spread_at(e, here), 9);
  EXPECT_LT(spread_at(e, near), 0.9 * near_before);
  EXPECT_EQ(spread_at(e, far), far_before);
}

TEST(Ensemble, ReadingsPushTheBoundaryToTheirSide) {
  for (const bool inside : {true, false}) {
    EnsembleEstimator e(prior(), {});
    // Half a sigma on the wrong side of the mean.
    const Vec2 p(inside ? 220 : 180, 0);
    const double before = e.ensemble().distance(p).mean;
    e.observe(reading(0, p, inside));
    const double after = e.ensemble().distance(p).mean;
    if (inside) {
      EXPECT_LT(after, before - 10);
    } else {
      EXPECT_GT(after, before + 10);
    }
  }
}

TEST(Ensemble, TheSameReadingCountsOnce) {
  EnsembleEstimator e(prior(), {});
  const Vec2 p(220, 0);
  e.observe(reading(0, p, true));
  const MemberValues once = e.ensemble().distance(p);
  for (int k = 0; k < 50; ++k) e.observe(reading(0, p, true));
  const MemberValues again = e.ensemble().distance(p);
  EXPECT_EQ(again.mean, once.mean);
  EXPECT_EQ(again.variance, once.variance);
}

TEST(Ensemble, AnImpossibleReadingIsSetAsideUntilOthersAgree) {
  PerimeterPrior p = prior();
  p.radius_sd = 10;
  EnsembleEstimator e(p, {});
  const Vec2 spot(0, 420);
  const double before = e.ensemble().distance(spot).mean;
  e.observe(reading(0, spot, true));
  EXPECT_EQ(e.health().outliers, 1);
  EXPECT_EQ(e.ensemble().distance(spot).mean, before);
  // Expected readings in between: the outliers are forgotten.
  e.observe(reading(0, Vec2(0, 0), true));
  e.observe(reading(0, spot, true));
  EXPECT_EQ(e.health().outliers, 2);
  EXPECT_EQ(e.ensemble().distance(spot).mean, before);
  // Agreeing ones for two seconds: there is a spot fire.
  for (int t = 1; t <= 3; ++t) {
    e.predict(Time::from_seconds(t));
    e.observe(reading(t, spot + Vec2(0, 5 * t), true));
  }
  EXPECT_LT(e.ensemble().distance(spot).mean, 0);
  EXPECT_GT(e.ensemble().distance(Vec2(0, 310)).mean, 0);
}

TEST(Ensemble, LearnsHowManyReadingsAreFalse) {
  for (const double share : {0.0, 0.02, 0.05}) {
    PerimeterPrior p = prior();
    p.radius = 400;
    EnsembleEstimator e(p, {});
    Weaving(wavy(31, 3, 20), 31, share).fly(e, 1, 600);
    // Near the edge a false reading looks like a right one: up to half are missed.
    EXPECT_GE(e.false_rate(), 0.4 * share);
    EXPECT_LE(e.false_rate(), 1.5 * share + 0.002);
  }
}

TEST(Ensemble, ACrossingThatIsTakenBackMovesNothing) {
  PerimeterPrior p = prior();
  p.radius_sd = 10;
  EnsembleEstimator e(p, {});
  const Vec2 there(260, 0);
  const MemberValues before = e.ensemble().distance(there);
  const double noise = e.ensemble().noise_factor();
  e.observe(crossing(0, there, Vec2(-15, 15), true));
  e.observe(crossing(1, there, Vec2(15, 15), false));
  EXPECT_EQ(e.ensemble().distance(there).mean, before.mean);
  EXPECT_EQ(e.ensemble().noise_factor(), noise);
  EXPECT_EQ(e.health().outliers, 0);
}

TEST(Ensemble, RecoversWhenTheBeliefIsWrong) {
  PerimeterPrior p = prior();
  p.radius_sd = 5;
  EnsembleEstimator e(p, {});
  // The boundary is 40 m further out than eight sigma of the belief.
  for (int t = 0; t <= 4; ++t) {
    e.predict(Time::from_seconds(t));
    e.observe(reading(t, Vec2(240, 10 * t), true));
  }
  EXPECT_LT(e.ensemble().distance(Vec2(240, 20)).mean, 0);
}

TEST(Ensemble, LearnsTheRateFromCrossings) {
  PerimeterPrior p = prior();
  p.radius_sd = 5;
  p.rate = 0.1;
  p.rate_sd = 0.2;
  EnsembleEstimator e(p, {});
  const double true_rate = 0.3;
  for (int t = 60; t <= 900; t += 60) {
    e.predict(Time::from_seconds(t));
    e.observe(crossing(t, Vec2(200 + true_rate * t, 0), Vec2(-20, 0), true));
  }
  // Fifteen crossings, each to 7 m over up to 900 s; rates are forgotten over 1200 s.
  EXPECT_NEAR(e.ensemble().speed(Vec2(200 + true_rate * 900, 0)).mean, true_rate, 0.06);
}

TEST(Ensemble, BoundaryHasEvenPointsAndDropsSpecks) {
  PerimeterPrior p = prior();
  p.radius_sd = 10;
  EnsembleEstimator e(p, {});
  const BoundaryEstimate b = e.boundary();
  ASSERT_EQ(b.rings.size(), 1U);
  geo::Ring ring;
  for (const BoundaryPoint& q : b.rings[0]) {
    ring.push_back(q.position);
    EXPECT_NEAR(q.normal.norm(), 1, 1e-9);
    EXPECT_GT(q.normal.dot(q.position.normalized()), 0.5);
    EXPECT_GT(q.sigma, 0);
  }
  EXPECT_GT(geo::signed_area(ring), 0);
  for (std::size_t k = 0; k < ring.size(); ++k)
    EXPECT_LE((ring[(k + 1) % ring.size()] - ring[k]).norm(), 50.001);
  EnsembleOptions coarse;
  coarse.min_area = 1e9;
  // The only part stays, however small.
  EXPECT_EQ(EnsembleEstimator(p, coarse).boundary().rings.size(), 1U);
}

TEST(Ensemble, SigmaGrowsWithoutObservations) {
  EnsembleEstimator e(prior(), {});
  const auto mean_sigma = [](const BoundaryEstimate& b) {
    double sum = 0;
    for (const BoundaryPoint& q : b.rings.at(0)) sum += q.sigma;
    return sum / static_cast<double>(b.rings[0].size());
  };
  double growth = 0;
  const BoundaryEstimate before = e.boundary();
  for (const BoundaryPoint& q : before.rings.at(0)) growth += q.sigma_growth;
  growth /= static_cast<double>(before.rings[0].size());
  e.predict(Time::from_seconds(60));
  const double change = mean_sigma(e.boundary()) - mean_sigma(before);
  EXPECT_GT(change, 0);
  // The announced growth is that of a straight front; curvature bends it.
  EXPECT_NEAR(change / 60, growth, 0.5 * growth);
}

TEST(Ensemble, AFarWrongOriginIsForgottenOnceTheEdgeWasFlown) {
  // Believed 150 m north of where the fire is.
  PerimeterPrior p = prior();
  p.radius_sd = 30;
  p.rate = 0.01;
  p.rate_sd = 0.01;
  EnsembleEstimator e(p, {});
  const Vec2 middle(-150, 0);
  for (int t = 1; t <= 200; ++t) {
    e.predict(Time::from_seconds(t));
    // Around the fire, 30 m to either side of its edge.
    const auto at = [&](int k) {
      return Vec2(middle + (150 + 30 * std::sin(0.5 * k)) * geo::unit(0.09 * k));
    };
    const bool inside = (at(t) - middle).norm() < 150;
    if (inside != ((at(t - 1) - middle).norm() < 150)) {
      e.observe(crossing(t, (at(t) + at(t - 1)) / 2, at(t) - at(t - 1), inside));
    } else {
      e.observe(reading(t, at(t), inside));
    }
  }
  double worst = 0;
  for (const auto& ring : e.boundary().rings)
    for (const BoundaryPoint& q : ring)
      worst = std::max(worst, std::abs((q.position - middle).norm() - 150));
  // The believed disc reached 200 m beyond the real one. What is left of it are lobes
  // between the last crossings, as wide as a neck that still joins parts.
  EXPECT_LT(worst, 60);
}

EnsembleEstimator flown() {
  EnsembleEstimator e(prior(), {});
  for (int t = 1; t <= 120; ++t) {
    e.predict(Time::from_seconds(t));
    const Vec2 at = (200 + 30 * std::sin(0.3 * t)) * geo::unit(0.05 * t);
    if (t % 10 == 0) {
      e.observe(crossing(t, at, Vec2(14, 14), t % 20 == 0));
    } else {
      e.observe(reading(t, at, at.norm() < 200));
    }
  }
  return e;
}

std::vector<double> numbers(const BoundaryEstimate& b) {
  std::vector<double> out;
  for (const auto& ring : b.rings)
    for (const BoundaryPoint& q : ring)
      out.insert(out.end(),
                 {q.position.x(), q.position.y(), q.sigma, q.sigma_growth, q.rate});
  return out;
}

TEST(Ensemble, SameInputsGiveTheSameBits) {
  EXPECT_EQ(numbers(flown().boundary()), numbers(flown().boundary()));
}

TEST(Ensemble, ACloneIsIndependent) {
  EnsembleEstimator e = flown();
  const std::unique_ptr<PerimeterEstimator> copy = e.clone();
  const auto before = numbers(e.boundary());
  EXPECT_EQ(numbers(copy->boundary()), before);
  copy->predict(Time::from_seconds(300));
  copy->observe(crossing(300, Vec2(300, 0), Vec2(20, 0), false));
  EXPECT_EQ(numbers(e.boundary()), before);
  // Both, given the same, stay the same: the random streams were copied too.
  e.predict(Time::from_seconds(300));
  e.observe(crossing(300, Vec2(300, 0), Vec2(20, 0), false));
  EXPECT_EQ(numbers(e.boundary()), numbers(copy->boundary()));
}

}  // namespace
}  // namespace skein::perimeter::ensemble_estimator_test
