// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/joint_estimator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/random.h"
#include "skein/geo/boundary_index.h"
#include "skein/geo/polygon.h"
#include "skein/layer/reasoning/perimeter/test/weaving.h"

namespace skein::perimeter::joint_estimator_test {
namespace {

// A fire that is a disc about the origin, watched along its edge at
// `bearings_per_second`.
struct Disc {
  double radius = 560, rate = 3.1;
  double at(double time) const { return radius + rate * time; }
};

void watch(PerimeterEstimator& estimator, const Disc& disc, int from, int to) {
  for (int second = from; second < to; ++second) {
    const Time now = Time::from_seconds(second);
    estimator.predict(now);
    for (std::uint32_t id = 0; id < 2; ++id) {
      const Vec2 e = geo::unit(0.025 * second + geo::kPi * id);
      if (second % 6 == 0) {
        // 8 m/s inwards: the edge is passed in the middle of the second.
        const double middle = disc.at(second - 0.5);
        estimator.observe(Crossing{
            now, {id}, middle * e, -8 * e + 17 * geo::turned_right(e), 0.5, true});
      } else {
        estimator.observe(FireReading{now, {id}, (disc.at(second) - 30) * e, 0.5, true});
      }
    }
  }
}

bool same(const BoundaryEstimate& a, const BoundaryEstimate& b) {
  if (a.rings.size() != b.rings.size() || a.rings[0].size() != b.rings[0].size())
    return false;
  for (std::size_t i = 0; i < a.rings[0].size(); ++i) {
    const BoundaryPoint& p = a.rings[0][i];
    const BoundaryPoint& q = b.rings[0][i];
    if (p.position != q.position || p.normal != q.normal || p.sigma != q.sigma ||
        p.sigma_growth != q.sigma_growth || p.rate != q.rate) {
      return false;
    }
  }
  return true;
}

TEST(JointEstimator, LearnsADiscAndItsRate) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{});
  const Disc disc;
  watch(estimator, disc, 1, 600);
  const BoundaryEstimate boundary = estimator.boundary();
  for (const BoundaryPoint& point : boundary.rings[0]) {
    // The edge crossings are 8 m wide each; some hundred of them average out.
    EXPECT_NEAR(point.position.norm(), disc.at(599), 4);
    EXPECT_NEAR(point.rate, disc.rate, 0.05);
    EXPECT_LT(point.sigma, 6);
    EXPECT_GT(point.sigma, 0.3);
  }
  EXPECT_EQ(estimator.health().outliers, 0);
  EXPECT_EQ(estimator.health().observations, 2 * 599);
}

TEST(JointEstimator, RecoversFromARateThatIsManySigmaOff) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{});
  const Disc disc{560, 1.5};  // believed: 3 with sd 0.058
  watch(estimator, disc, 1, 900);
  const BoundaryEstimate boundary = estimator.boundary();
  for (const BoundaryPoint& point : boundary.rings[0]) {
    EXPECT_NEAR(point.position.norm(), disc.at(899), 15);
  }
}

TEST(JointEstimator, GivesAPositiveRingWithConsistentNormals) {
  JointEstimator estimator(PerimeterPrior{.origin = {1000, -400}}, JointOptions{});
  estimator.predict(Time::from_seconds(30));
  const BoundaryEstimate boundary = estimator.boundary();
  ASSERT_EQ(boundary.rings.size(), 1U);
  ASSERT_EQ(boundary.rings[0].size(), 60U);
  geo::Ring ring;
  for (const BoundaryPoint& point : boundary.rings[0]) {
    ring.push_back(point.position);
    EXPECT_NEAR(point.normal.norm(), 1, 1e-12);
    EXPECT_NEAR((point.position - Vec2(1000, -400)).normalized().dot(point.normal), 1,
                1e-9);
    EXPECT_GT(point.sigma_growth, 0);
  }
  EXPECT_GT(geo::signed_area(ring), 0);
  EXPECT_EQ(boundary.time, Time::from_seconds(30));
}

TEST(JointEstimator, AdaptiveControlPointsKeepTheirSpacing) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{.spacing = 50});
  const auto ring = estimator.boundary().rings[0];
  EXPECT_GE(ring.size(), 63U);  // 2 pi 500 / 50
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const double gap = (ring[(i + 1) % ring.size()].position - ring[i].position).norm();
    EXPECT_LE(gap, 50);
    EXPECT_GE(gap, 45);
  }
}

TEST(JointEstimator, SetsAsideAReadingThatIsAllButImpossible) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{});
  watch(estimator, Disc{}, 1, 300);
  const BoundaryEstimate before = estimator.boundary();
  estimator.observe(FireReading{Time::from_seconds(299), {0}, {5000, 0}, 1, true});
  EXPECT_EQ(estimator.health().outliers, 1);
  EXPECT_TRUE(same(before, estimator.boundary()));
}

TEST(JointEstimator, IsCorrectedWhenImpossibleReadingsPersist) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{});
  watch(estimator, Disc{}, 1, 300);
  const double radius = Disc{}.at(299);
  for (int i = 0; i < 6; ++i) {
    const Time now = Time::from_seconds(300 + i);
    estimator.predict(now);
    estimator.observe(FireReading{now, {0}, {radius + 400, 0}, 1, true});
  }
  EXPECT_GT(estimator.at(0).radius, radius + 300);
  // The other side keeps what is known of it.
  EXPECT_NEAR(estimator.at(geo::kPi).radius, Disc{}.at(305), 15);
}

PerimeterPrior still_prior() {
  return {.radius = 400, .radius_sd = 60, .rate = 0.2, .rate_sd = 0.15, .wind_sd = 0.05};
}

// Root mean square of the error over the stated deviation, over all bearings.
double relative_error(const JointEstimator& estimator, const geo::Ring& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const BoundaryFilter::Local local = estimator.at(geo::bearing(truth[i]));
    const double off = local.radius - truth[i].norm();
    sum += off * off / local.variance / static_cast<double>(truth.size());
  }
  return std::sqrt(sum);
}

TEST(JointEstimator, KnowsAJaggedFireAsWellAsItSays) {
  for (const std::uint64_t seed : {11, 12, 13, 14}) {
    const geo::Ring truth = wavy(seed, 20, 12);
    JointEstimator estimator(still_prior(), JointOptions{});
    Weaving(truth, seed).fly(estimator, 1, 500);
    EXPECT_LT(relative_error(estimator, truth), 1.6) << seed;
  }
}

TEST(JointEstimator, IsModestWhereTheFireIsNotStarShaped) {
  // Ls of several arms, round whose corner no bearing looks.
  for (const double arm : {700.0, 900.0, 1100.0}) {
    const geo::Ring truth = {{-300, -300}, {900, -300}, {900, -100},
                             {-50, -100},  {-50, arm},  {-300, arm}};
    const geo::BoundaryIndex index(geo::Region{truth});
    JointEstimator estimator(still_prior(), JointOptions{});
    Weaving weaving(truth, 41);
    double square = 0;
    int count = 0;
    for (int second = 300; second < 900; second += 20) {
      weaving.fly(estimator, second == 300 ? 1 : second, second + 20);
      const BoundaryEstimate believed = estimator.boundary();
      for (const BoundaryPoint& point : believed.rings[0]) {
        const double off = index.nearest(point.position).distance;
        square += off * off / (point.sigma * point.sigma);
        ++count;
      }
    }
    // Far from 1, but no longer the 54,000 of flanks known to millimetres.
    EXPECT_LT(square / count, 100) << arm;
  }
}

TEST(JointEstimator, LearnsHowManyReadingsAreFalse) {
  for (const std::uint64_t seed : {21, 22, 23}) {
    for (const double share : {0.0, 0.02, 0.05}) {
      const geo::Ring truth = wavy(seed, 3, 20);
      JointEstimator estimator(still_prior(), JointOptions{});
      Weaving(truth, seed, share).fly(estimator, 1, 900);
      // Near the edge a false reading looks like a right one: many are missed.
      EXPECT_GE(estimator.false_rate(), 0.15 * share) << seed;
      EXPECT_LE(estimator.false_rate(), 1.5 * share + 0.002) << seed;
      EXPECT_LT(relative_error(estimator, truth), 1.5) << seed << " " << share;
    }
  }
}

TEST(JointEstimator, ACrossingThatIsTakenBackMovesNothing) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{});
  watch(estimator, Disc{}, 1, 300);
  const double radius = Disc{}.at(299);
  JointEstimator same_without(estimator);
  const Vec2 outside(radius + 40, 0);
  estimator.predict(Time::from_seconds(301));
  estimator.observe(Crossing{Time::from_seconds(301), {0}, outside, {-8, 17}, 0.5, true});
  estimator.predict(Time::from_seconds(301));
  estimator.observe(
      Crossing{Time::from_seconds(301), {0}, outside, {-8, 17}, 0.5, false});
  same_without.predict(Time::from_seconds(301));
  EXPECT_NEAR(estimator.at(0).radius, same_without.at(0).radius, 0.1);
  EXPECT_NEAR(estimator.at(0).variance, same_without.at(0).variance,
              0.02 * same_without.at(0).variance);
  EXPECT_GT(estimator.false_rate(), same_without.false_rate());
}

TEST(JointEstimator, CloneContinuesAsTheOriginal) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{});
  watch(estimator, Disc{}, 1, 100);
  const auto copy = estimator.clone();
  watch(estimator, Disc{}, 100, 200);
  EXPECT_FALSE(same(estimator.boundary(), copy->boundary()));
  watch(*copy, Disc{}, 100, 200);
  EXPECT_TRUE(same(estimator.boundary(), copy->boundary()));
}

TEST(JointEstimator, TakesInMoreAircraftThanItWasMadeFor) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{.aircraft = 1});
  watch(estimator, Disc{}, 1, 50);
  EXPECT_EQ(estimator.health().observations, 2 * 49);
}

// Steps of the boundary between sectors with rates of their own: far rougher than the
// smoothest hypotheses believe. The filter has to notice.
TEST(JointEstimator, NoticesARateThatJumpsFromSectorToSector) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{});
  RandomStream random(5, 0, Purpose::kTest);
  std::vector<double> rates;
  for (int i = 0; i < 60; ++i) rates.push_back(3 + random.uniform(-0.1, 0.1));
  const auto radius = [&rates](double bearing, double time) {
    const auto sector =
        static_cast<std::size_t>(geo::wrap_2pi(bearing) / (2 * geo::kPi) * 60);
    return 500 + rates[std::min<std::size_t>(sector, 59)] * time;
  };
  double nees = 0;
  int points = 0, covered = 0;
  for (int second = 1; second < 1800; ++second) {
    const Time now = Time::from_seconds(second);
    estimator.predict(now);
    for (std::uint32_t id = 0; id < 2 && second % 6 == 0; ++id) {
      const double bearing = 0.005 * second + geo::kPi * id;
      const double middle = radius(bearing, second - 0.5) + random.uniform(-5, 5);
      estimator.observe(Crossing{
          now, {id}, middle * geo::unit(bearing), -8 * geo::unit(bearing), 0, true});
    }
    if (second < 900 || second % 50 != 0) continue;
    // In the middle of the sectors, where the boundary is well defined.
    for (int i = 0; i < 60; ++i) {
      const double bearing = (i + 0.5) * geo::kPi / 30;
      const BoundaryFilter::Local local = estimator.at(bearing);
      const double error = local.radius - radius(bearing, second);
      nees += error * error / local.variance;
      covered += std::abs(error) < 1.96 * std::sqrt(local.variance) ? 1 : 0;
      ++points;
    }
  }
  EXPECT_GT(estimator.weights()[2], 0.5);  // the rough one
  // What is asked of the filter in this case; a smooth prior alone covers a third.
  EXPECT_GT(static_cast<double>(covered) / points, 0.85);
  EXPECT_LT(nees / points, 2);
}

// Truth drawn from a hypothesis's own prior, watched with random crossings: the errors
// must be as large as the filter says.
TEST(JointEstimator, IsConsistentOnItsOwnModel) {
  PerimeterPrior prior;
  BoundaryHypothesis own;
  own.radius = {100, 6};
  own.rate = {0.06, 8};
  own.mean_rate_sd = 0.1;
  own.wind_sd = 0;
  double nees = 0;
  int points = 0, covered = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    RandomStream random(seed, 0, Purpose::kTest);
    // A random function with the same harmonics: variance of harmonic k is 1/(1 +
    // (k/c)^6).
    const auto draw = [&random](const Roughness& roughness, bool with_mean) {
      std::vector<double> c(31), s(31);
      double total = 0;
      for (int k = with_mean ? 0 : 1; k <= 30; ++k) {
        const double variance = 1 / (1 + std::pow(k / roughness.cutoff, 6));
        total += variance;
        c[static_cast<std::size_t>(k)] = std::sqrt(variance) * random.normal();
        s[static_cast<std::size_t>(k)] = std::sqrt(variance) * random.normal();
      }
      return [c, s, scale = roughness.sd / std::sqrt(total)](double bearing) {
        double sum = 0;
        for (std::size_t k = 0; k < c.size(); ++k) {
          const double angle = static_cast<double>(k) * bearing;
          sum += c[k] * std::cos(angle) + s[k] * std::sin(angle);
        }
        return scale * sum;
      };
    };
    const auto shape = draw(own.radius, true);
    const auto rate = draw(own.rate, false);
    const double mean_rate = prior.rate + own.mean_rate_sd * random.normal();
    const auto radius = [&](double bearing, double time) {
      return prior.radius + shape(bearing) + (mean_rate + rate(bearing)) * time;
    };
    JointEstimator estimator(prior, JointOptions{.false_rate = 0}, {own});
    for (int step = 1; step <= 120; ++step) {
      const Time now = Time::from_seconds(5 * step);
      estimator.predict(now);
      const double bearing = random.uniform(-3.14, 3.14);
      const Vec2 e = geo::unit(bearing);
      // The crossing is anywhere on a 20 m long track straight in.
      const double offset = random.uniform(-10, 10);
      estimator.observe(Crossing{
          now, {0}, (radius(bearing, now.seconds()) + offset) * e, -20 * e, 0, true});
    }
    const BoundaryEstimate boundary = estimator.boundary();
    for (const BoundaryPoint& point : boundary.rings[0]) {
      const double error =
          point.position.norm() - radius(geo::bearing(point.position), 600);
      nees += std::pow(error / point.sigma, 2);
      covered += std::abs(error) < 1.96 * point.sigma ? 1 : 0;
      ++points;
    }
  }
  nees /= points;
  // 12 runs with about 15 independent numbers each: sd of the mean of chi-square 0.1; the
  // filter takes the boundary's own motion during the second for part of the track's.
  EXPECT_GT(nees, 0.6);
  EXPECT_LT(nees, 1.5);
  EXPECT_GT(static_cast<double>(covered) / points, 0.88);
}

TEST(JointEstimator, KeepsFiniteNumbersWhereTheWholePriorIsWrong) {
  // Given 500 m and 3 m/s; there is no fire at all: every reading is outside, also at the
  // origin.
  PerimeterPrior prior;
  JointEstimator estimator(prior, {});
  RandomStream random(5, 0, Purpose::kTest);
  for (int t = 0; t < 1500; ++t) {
    estimator.predict(Time::from_seconds(t));
    FireReading reading;
    reading.time = Time::from_seconds(t);
    reading.point = {400 * random.normal(), 400 * random.normal()};
    reading.point_sd = 2;
    estimator.observe(reading);
    const BoundaryEstimate boundary = estimator.boundary();
    for (const BoundaryPoint& point : boundary.rings.at(0)) {
      ASSERT_TRUE(point.position.allFinite() && std::isfinite(point.sigma)) << t;
      ASSERT_LT(point.position.norm(), 4e7) << t;
    }
  }
  for (const double weight : estimator.weights()) EXPECT_TRUE(std::isfinite(weight));
}

}  // namespace
}  // namespace skein::perimeter::joint_estimator_test
