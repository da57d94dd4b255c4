// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/forecast.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/reasoning/perimeter/coordinator/forecast_calibration.h"

namespace skein::perimeter::forecast_test {
namespace {

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

// A circle that grows evenly, with a deviation that grows too.
class GrowingCircle final : public PerimeterEstimator {
 public:
  void predict(Time time) override { time_ = time; }
  void observe(const FireReading&) override {}
  void observe(const Crossing&) override {}
  BoundaryEstimate boundary() const override {
    const double radius = 200 + 0.1 * time_.seconds();
    BoundaryEstimate boundary;
    boundary.time = time_;
    boundary.rings.emplace_back();
    for (int k = 0; k < 360; ++k) {
      const Vec2 out = geo::unit(geo::radians(k));
      boundary.rings[0].push_back(
          {radius * out, out, 5 + 0.01 * time_.seconds(), 0.01, 0.1});
    }
    return boundary;
  }
  EstimatorHealth health() const override { return {}; }
  std::unique_ptr<PerimeterEstimator> clone() const override {
    return std::make_unique<GrowingCircle>(*this);
  }

 private:
  Time time_;
};

double radius_of(const BoundaryEstimate& boundary) {
  return boundary.rings.front().front().position.norm();
}

Forecast forecast(const PerimeterEstimator& estimator, Time now,
                  const ForecastOptions& options, double spread = 1) {
  ForecastRun run(estimator, now, options, spread);
  while (!run.advance()) {
  }
  return run.take();
}

TEST(Forecast, AsksTheEstimatorForEachHorizonAndLeavesItAsItIs) {
  GrowingCircle estimator;
  estimator.predict(at(100));
  ForecastOptions options;
  options.horizons = {600, 1800};
  const Forecast ahead = forecast(estimator, at(110), options);
  ASSERT_EQ(ahead.boundaries.size(), 2u);
  EXPECT_EQ(ahead.boundaries[0].time, at(710));
  EXPECT_NEAR(radius_of(ahead.boundaries[0]), 271, 1e-9);
  EXPECT_EQ(ahead.boundaries[1].time, at(1910));
  EXPECT_NEAR(radius_of(ahead.boundaries[1]), 391, 1e-9);
  EXPECT_NEAR(radius_of(estimator.boundary()), 210, 1e-9);
  EXPECT_EQ(ahead.made, at(110));
}

TEST(Forecast, SaysWhenTheFireComesToAPlace) {
  GrowingCircle estimator;
  ForecastOptions options;
  options.horizons = {600, 3600};
  options.places = {{"hut", {350, 0}}, {"camp", {100, 0}}, {"town", {0, 5000}}};
  const Forecast ahead = forecast(estimator, at(0), options);
  ASSERT_EQ(ahead.boundaries.size(), 2u) << "steps of distributions are no forecasts";
  ASSERT_EQ(ahead.arrivals.size(), 3u);
  const ArrivalForecast& hut = ahead.arrivals[0];
  // 150 m at 0.1 m/s; the deviation is then 20 m, or 200 s.
  ASSERT_TRUE(hut.early && hut.middle && hut.late);
  EXPECT_NEAR(*hut.middle, 1500, 40);
  EXPECT_NEAR(*hut.late - *hut.early, 2 * 1.28 * 200, 130);
  double before = 0;
  for (const ArrivalStep& step : hut.steps) {
    EXPECT_GE(step.probability, before);
    before = step.probability;
  }
  EXPECT_GT(before, 0.99);
  EXPECT_EQ(ahead.arrivals[1].early, 0.0) << "it burns already";
  EXPECT_FALSE(ahead.arrivals[2].early) << "not within an hour";
}

TEST(ProbabilityInside, FollowsTheDistanceInDeviations) {
  GrowingCircle estimator;
  const BoundaryEstimate boundary = estimator.boundary();  // 200 m, deviation 5 m
  EXPECT_NEAR(probability_inside(boundary, {200, 0}), 0.5, 1e-3);
  EXPECT_NEAR(probability_inside(boundary, {0, 195}), 0.8413, 2e-3);
  EXPECT_NEAR(probability_inside(boundary, {-210, 0}), 0.0228, 2e-3);
  EXPECT_EQ(probability_inside(BoundaryEstimate(), {0, 0}), 0);
  BoundaryEstimate line = boundary;
  line.rings.insert(line.rings.begin(), {{}, {}});  // two points enclose nothing
  EXPECT_NEAR(probability_inside(line, {200, 0}), 0.5, 1e-3);
}

TEST(ForecastCalibration, WidensForecastsThatTurnedOutTooSure) {
  GrowingCircle estimator;
  ForecastOptions options;
  options.horizons = {600};
  options.period = at(600);
  ForecastCalibration calibration;
  EXPECT_EQ(calibration.spread(), 1);
  const Forecast first = forecast(estimator, at(0), options);
  EXPECT_EQ(first.check.time, at(600));
  calibration.keep(first.check);
  estimator.predict(at(600));
  calibration.compare(estimator.boundary());
  EXPECT_EQ(calibration.spread(), 1) << "it was right";

  // Forecasts of 260 m with 11 m of deviation; it is 304 m: four deviations.
  for (int k = 0; k < 20; ++k) {
    BoundaryEstimate later = first.check;
    for (BoundaryPoint& point : later.rings[0]) point.position *= 304.0 / 260;
    calibration.keep(first.check);
    later.time = at(599);
    calibration.compare(later);  // too early to say
    later.time = at(600);
    calibration.compare(later);
  }
  EXPECT_NEAR(calibration.spread(), 4, 0.1);
  const Forecast wide = forecast(estimator, at(600), options, calibration.spread());
  EXPECT_NEAR(wide.boundaries[0].rings[0][0].sigma, 4 * 17, 2);
  EXPECT_NEAR(wide.check.rings[0][0].sigma, 17, 1e-9) << "it learns from the unwidened";
}

}  // namespace
}  // namespace skein::perimeter::forecast_test
