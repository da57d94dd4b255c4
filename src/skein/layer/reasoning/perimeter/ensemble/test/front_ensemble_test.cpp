// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/ensemble/front_ensemble.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "skein/layer/reasoning/perimeter/ensemble/localisation.h"

namespace skein::perimeter::front_ensemble_test {
namespace {

PerimeterPrior prior() {
  PerimeterPrior p;
  p.origin = Vec2(100, -50);
  p.radius = 200;
  p.radius_sd = 40;
  p.rate = 0.2;
  p.rate_sd = 0.05;
  p.wind_sd = 0.01;
  return p;
}

TEST(Localisation, FallsSmoothlyFromOneToZero) {
  EXPECT_DOUBLE_EQ(gaspari_cohn(0), 1);
  // The two pieces meet at 1 with value 5/24.
  EXPECT_NEAR(gaspari_cohn(1), 5.0 / 24, 1e-12);
  EXPECT_NEAR(gaspari_cohn(1 + 1e-9), 5.0 / 24, 1e-8);
  EXPECT_NEAR(gaspari_cohn(2 - 1e-6), 0, 1e-12);
  EXPECT_EQ(gaspari_cohn(2.5), 0);
  for (double z = 0.01; z < 2; z += 0.01)
    EXPECT_LT(gaspari_cohn(z), gaspari_cohn(z - 0.01));
}

TEST(FrontEnsemble, StartsAsThePriorSays) {
  EnsembleOptions options;
  options.members = 100;
  const FrontEnsemble ensemble(prior(), options);
  double mean = 0, variance = 0;
  for (int k = 0; k < 16; ++k) {
    const MemberValues d =
        ensemble.distance(prior().origin + 200 * geo::unit(k * geo::kPi / 8));
    mean += d.mean / 16;
    variance += d.variance / 16;
  }
  // Around the circle there are about 8 independent displacements of 40 m in each of 100
  // members: 1.4 m on the mean, 3.5 % on the spread; redistancing a rough boundary bends
  // both by more, which is what the rest allows for.
  EXPECT_NEAR(mean, 0, 10);
  EXPECT_NEAR(std::sqrt(variance), 40, 10);
}

TEST(FrontEnsemble, KnowsHowFarItIsToPlacesBeyondItsGrid) {
  PerimeterPrior p = prior();
  p.radius_sd = 1;
  const FrontEnsemble ensemble(p, {});
  // Straight beyond the middle of a side of the grid; a cell is 10 m.
  EXPECT_NEAR(ensemble.distance(p.origin + Vec2(5000, 0)).mean, 4800, 10);
}

TEST(FrontEnsemble, SpreadsAtTheBelievedRate) {
  PerimeterPrior p = prior();
  p.radius_sd = 1;
  p.rate_sd = 0.001;
  p.wind_sd = 0;
  FrontEnsemble ensemble(p, {});
  ensemble.predict(600);
  // 0.2 m/s for 600 s is 120 m; a cell is 10 m.
  for (int k = 0; k < 8; ++k)
    EXPECT_NEAR(ensemble.distance(p.origin + 320 * geo::unit(k * geo::kPi / 4)).mean, 0,
                3);
}

TEST(FrontEnsemble, RegressionTeachesTheNeighbourhoodOnly) {
  FrontEnsemble ensemble(prior(), {});
  const Vec2 at = prior().origin + Vec2(200, 0), far = prior().origin - Vec2(200, 0);
  const MemberValues before = ensemble.distance(at), far_before = ensemble.distance(far);
  ensemble.regress(at, before, -30 - before.mean, 0.2);
  const MemberValues after = ensemble.distance(at), far_after = ensemble.distance(far);
  // Exact at a node; between nodes the regressions of four neighbours are interpolated.
  EXPECT_NEAR(after.mean, -30, 3);
  EXPECT_NEAR(std::sqrt(after.variance), 0.2 * std::sqrt(before.variance), 3);
  EXPECT_EQ(far_after.mean, far_before.mean);
  EXPECT_EQ(far_after.variance, far_before.variance);
}

TEST(FrontEnsemble, TheOtherSideOfANarrowFingerStaysWhereItIs) {
  PerimeterPrior p = prior();
  p.radius = 60;
  p.radius_sd = 15;
  FrontEnsemble ensemble(p, {});
  const Vec2 east = p.origin + Vec2(0, 60), west = p.origin - Vec2(0, 60);
  const double before = ensemble.distance(west).mean;
  const MemberValues at = ensemble.distance(east);
  ensemble.regress(east, at, -20, 1);
  // 120 m apart, well within reach; opposite normals.
  EXPECT_NEAR(ensemble.distance(west).mean, before, 1.0);
}

TEST(FrontEnsemble, AStampIsAPartOfItsOwnAndMergesInTime) {
  PerimeterPrior p = prior();
  p.radius = 100;
  p.radius_sd = 5;
  FrontEnsemble ensemble(p, {});
  const Vec2 spot = p.origin + Vec2(0, 260);
  EXPECT_GT(ensemble.distance(spot).mean, 100);
  ensemble.stamp(spot, true, Eigen::VectorXd::Constant(ensemble.size(), 40));
  const Vec2 between = p.origin + Vec2(0, 160);
  EXPECT_NEAR(ensemble.distance(spot).mean, -40, 5);
  EXPECT_GT(ensemble.distance(between).mean, 30);
  ensemble.predict(600);
  EXPECT_LT(ensemble.distance(between).mean, 0);
}

TEST(FrontEnsemble, GridGrowsWithTheFireAndCoarsensWithinItsLimit) {
  PerimeterPrior p = prior();
  p.rate = 3;
  p.rate_sd = 0.1;
  EnsembleOptions options;
  options.members = 8;
  options.max_nodes = 20000;
  FrontEnsemble ensemble(p, options);
  const double first_cell = ensemble.grid().cell;
  for (int k = 0; k < 20; ++k) {
    ensemble.predict(60);
    EXPECT_LE(ensemble.grid().size(), 20000U);
  }
  EXPECT_GT(ensemble.grid().cell, first_cell);
  // 200 m + 3 m/s * 1200 s, known to 0.1/sqrt(2) m/s per member from the common rate
  // (85 m), a third of it for the mean of eight, plus the local rates.
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(ensemble.distance(p.origin + 3800 * geo::unit(k * geo::kPi / 2)).mean, 0,
                150);
}

TEST(FrontEnsemble, APartFarAwayCoarsensTheGridBeforeItTakesMemory) {
  const auto peak_mb = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
  };
  EnsembleOptions options;
  options.members = 8;
  options.max_nodes = 10000;
  FrontEnsemble ensemble(prior(), options);
  const double before = peak_mb();
  // With the cells of the start: some 3e7 nodes for each member, together 1 GB.
  const Vec2 far = prior().origin + Vec2(40e3, -40e3);
  ensemble.stamp(far, true, Eigen::VectorXd::Constant(ensemble.size(), 2000));
  EXPECT_LT(peak_mb() - before, 50);
  EXPECT_LE(ensemble.grid().size(), 10000U);
  EXPECT_LT(ensemble.distance(far).mean, 0);
}

}  // namespace
}  // namespace skein::perimeter::front_ensemble_test
