// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/metrics.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "sample_run.h"
#include "skein/record/figures/reading_ages.h"

namespace skein::record::metrics_test {
namespace {

const Vec2 kCentre(100, -50);

TEST(PerimeterMetrics, KnowsConcentricCircles) {
  // 2,000 edges deviate from a circle of 500 m by 500 (1 - cos(pi/2000)) = 0.6 mm.
  const geo::Region truth = {circle(kCentre, 500, 2000)};
  const auto m = perimeter_metrics(truth, believed_circle({}, kCentre, 530, 40, 360));
  EXPECT_NEAR(*m.rmse, 30, 1e-3);
  EXPECT_NEAR(*m.sigma, 40, 1e-9);
  EXPECT_NEAR(*m.perf, 50, 1e-3);
  // The chords of the believed 360-gon run up to 2 cm inside its circle.
  EXPECT_NEAR(*m.boundary_rms, 30, 0.03);
  EXPECT_NEAR(*m.boundary_hausdorff, 30, 0.03);
  EXPECT_NEAR(*m.iou, 500.0 * 500 / (530 * 530), 1e-4);
  EXPECT_EQ(*m.coverage_95, 1);
  EXPECT_NEAR(*m.nees, 9.0 / 16, 1e-4);
  EXPECT_NEAR(*m.truth_area, geo::kPi * 500 * 500, 2);
  EXPECT_NEAR(*m.area_error, geo::kPi * (530 * 530 - 500 * 500), 60);
}

TEST(PerimeterMetrics, CrpsIsTheIntegralOfItsDefinition) {
  // Integral of (Phi((x - err)/sigma) - [x >= 0])^2, by the midpoint rule in 1 cm steps:
  // its error is below 1e-4 m here.
  const double err = 30, sigma = 40;
  double integral = 0;
  for (double x = -600 + 0.005; x < 600; x += 0.01) {
    const double f = 0.5 * std::erfc(-(x - err) / sigma / std::sqrt(2.0));
    integral += 0.01 * std::pow(f - (x >= 0 ? 1 : 0), 2);
  }
  const geo::Region truth = {circle(kCentre, 500, 2000)};
  const auto m = perimeter_metrics(truth, believed_circle({}, kCentre, 530, 40, 360));
  EXPECT_NEAR(*m.crps, integral, 2e-3);
}

TEST(PerimeterMetrics, SeesWhatOnlyOneDirectionShows) {
  // The belief misses an island: each of its points is right, the boundary is not.
  const geo::Region truth = {circle({0, 0}, 500, 1000), circle({2000, 0}, 100, 200)};
  const auto m = perimeter_metrics(truth, believed_circle({}, {0, 0}, 500, 5, 1000));
  EXPECT_LT(*m.rmse, 0.01);
  EXPECT_NEAR(*m.boundary_hausdorff, 1600, 3);  // samples stand up to 25 m apart
  EXPECT_GT(*m.boundary_rms, 300);
  EXPECT_NEAR(*m.iou, 25.0 / 26, 1e-4);
}

TEST(PerimeterMetrics, LeavesOutWhatCannotBeSaid) {
  const geo::Region fire = {circle({0, 0}, 500, 100)};
  const BoundaryEstimate nothing;

  const auto unknown = perimeter_metrics(fire, nothing);
  EXPECT_EQ(unknown.iou, 0);
  EXPECT_FALSE(unknown.perf || unknown.boundary_rms || unknown.nees || unknown.crps);
  EXPECT_NEAR(*unknown.area_error, -*unknown.truth_area, 1e-6);

  const auto imagined = perimeter_metrics({}, believed_circle({}, {0, 0}, 500, 5));
  EXPECT_EQ(imagined.iou, 0);
  EXPECT_FALSE(imagined.perf || imagined.boundary_rms || imagined.coverage_95);

  const auto none = perimeter_metrics(geo::Region{}, nothing);
  EXPECT_EQ(none.iou, 1);
  EXPECT_EQ(none.area_error, 0);

  const auto certain = perimeter_metrics(fire, believed_circle({}, {0, 0}, 510, 0));
  EXPECT_FALSE(certain.nees);
  EXPECT_NEAR(*certain.crps, *certain.rmse, 0.2);  // CRPS of a sure belief is |err|
  EXPECT_EQ(certain.coverage_95, 0);
}

TEST(PerimeterMetrics, ToleratesACrossedBelief) {
  BoundaryEstimate eight;
  eight.rings.emplace_back();
  for (const Vec2& p : {Vec2(0, 0), Vec2(100, 100), Vec2(100, 0), Vec2(0, 100)})
    eight.rings[0].push_back({p, {1, 0}, 5, 0, 0});
  const auto m = perimeter_metrics({circle({50, 50}, 60, 100)}, eight);
  for (const MetricField& field : metric_fields())
    if (m.*field.value) {
      EXPECT_TRUE(std::isfinite(*(m.*field.value))) << field.name;
    }
}

TEST(PerimeterMetrics, BearABeliefBeyondTheEarth) {
  // As an approximation that diverged.
  const auto m = perimeter_metrics({circle({0, 0}, 500, 100)},
                                   believed_circle(Time(), {0, 0}, 5e8, 1e7));
  EXPECT_GT(*m.boundary_hausdorff, 4e8);
  EXPECT_LT(*m.iou, 1e-3);
  EXPECT_TRUE(std::isfinite(*m.area_error));
}

TEST(ReadingAges, FollowTheFrontAfterACrossing) {
  ReadingAges ages;
  ages.add({Time::from_seconds(10), EntityId{1}, {500, 0}, {20, 0}, 1, false});

  // The front grows to three times its length in 100 s. What is known of its northern
  // part is 100 s old, in the same share of the boundary as at first: 200 m of 2 pi 500
  // m.
  std::optional<ReadingAges::Ages> now;
  for (double t = 10; t <= 110; t += 5) {
    const double radius = 500 + 10 * (t - 10);
    now = ages.ages(Time::from_seconds(t), TrueBoundary({circle({0, 0}, radius, 720)}),
                    believed_circle(Time::from_seconds(t), {0, 0}, radius + 7, 10, 720));
  }
  ASSERT_TRUE(now);
  EXPECT_NEAR(now->max, 110, 1e-9);
  const double share = (110 - now->mean) / 10;
  // Markers stand 25 m apart at first: each end of that part is right to one of them.
  EXPECT_NEAR(share, 200 / (2 * geo::kPi * 500), 2 * 25 / (2 * geo::kPi * 500));
}

TEST(ReadingAges, CountAnIslandFromTheStart) {
  ReadingAges ages;
  const Time now = Time::from_seconds(100);
  for (int i = 0; i < 30; ++i) {  // the main fire is crossed everywhere at 100 s
    const EntityId uav{static_cast<std::uint32_t>(i)};
    const Vec2 out = geo::unit(0.21 * i);
    ages.add({now, uav, 500 * out, 20 * out, 1, false});
  }
  const geo::Ring fire = circle({0, 0}, 500, 200);
  const auto belief = believed_circle(now, {0, 0}, 500, 10);
  EXPECT_EQ(ages.ages(now, TrueBoundary({fire}), belief)->max, 0);
  const auto island = believed_circle(now, {2000, 0}, 50, 10);
  const TrueBoundary both({fire, circle({2000, 0}, 50, 20)});
  EXPECT_EQ(ages.ages(now, both, island)->mean, 100);
  EXPECT_EQ(ages.ages(now, both, belief)->max, 0);
}

TEST(ReadingAges, TakeLateCrossingsInAnyOrder) {
  ReadingAges ages;
  ages.add({Time::from_seconds(8), EntityId{1}, {500, 0}, {20, 0}, 1, false});
  ages.add({Time::from_seconds(5), EntityId{2}, {500, 0}, {20, 0}, 1, false});
  const Time now = Time::from_seconds(10);
  const TrueBoundary small({circle({480, 0}, 20, 40)});  // all of it within reach
  EXPECT_NEAR(ages.ages(now, small, believed_circle(now, {480, 0}, 20, 5))->max, 2, 1e-9);
}

}  // namespace
}  // namespace skein::record::metrics_test
