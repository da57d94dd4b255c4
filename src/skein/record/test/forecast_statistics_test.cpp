// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/forecast_statistics.h"

#include <gtest/gtest.h>

#include "skein/record/test/sample_run.h"

namespace skein::record::forecast_statistics_test {
namespace {

const EntityId kStation{0};

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

ForecastRecord forecast(double made, double time, double radius, double sigma,
                        const std::string& mission = "m") {
  return {kStation,
          {at(made), believed_circle(at(time), {0, 0}, radius, sigma, 360), 0, mission}};
}

TrueBoundary truth(double radius) {
  return TrueBoundary({circle({0, 0}, radius, 720)});
}

std::map<std::string, double> figures(const ForecastStatistics& statistics) {
  std::map<std::string, double> all;
  statistics.add_figures(all);
  return all;
}

TEST(ForecastFigures, CompareEachForecastWithTheTruthOfItsTime) {
  ForecastStatistics statistics;
  statistics.forecast(forecast(0, 600, 300, 20));
  statistics.forecast(forecast(0, 1800, 400, 20));
  statistics.truth(at(300), 0, truth(250));
  EXPECT_TRUE(statistics.take_scores().empty());
  statistics.truth(at(600), 1, truth(100));  // of another fire
  EXPECT_TRUE(statistics.take_scores().empty());
  statistics.truth(at(600), 0, truth(310));
  const auto scores = statistics.take_scores();
  ASSERT_EQ(scores.size(), 1u);
  EXPECT_NEAR(*scores[0].metrics.iou, 300.0 * 300 / (310 * 310), 1e-3);
  const auto all = figures(statistics);
  EXPECT_NEAR(all.at("forecast_600s_iou_mean"), 0.9365, 1e-3);
  EXPECT_EQ(all.at("forecast_600s_coverage_95_mean"), 1);  // 10 m off, sigma 20 m
  EXPECT_NEAR(all.at("forecast_600s_boundary_rms_mean_m"), 10, 0.1);
  EXPECT_FALSE(all.contains("forecast_1800s_iou_mean"));
}

TEST(ForecastFigures, OfSeveralMissionsHaveTheirNames) {
  ForecastStatistics statistics;
  statistics.forecast(forecast(0, 600, 300, 20));
  statistics.forecast(forecast(0, 600, 310, 20, "other"));
  statistics.truth(at(600), 0, truth(310));
  const auto all = figures(statistics);
  EXPECT_LT(all.at("forecast_600s_iou_mean"), 0.95);
  EXPECT_GT(all.at("mission_other_forecast_600s_iou_mean"), 0.999);
}

ArrivalRecord arrival(double made, std::vector<ArrivalStep> steps) {
  ArrivalForecast forecast;
  forecast.made = at(made);
  forecast.place = "hut";
  forecast.point = {300, 0};
  forecast.steps = std::move(steps);
  return {kStation, forecast};
}

TEST(ArrivalFigures, OfOnePlaceAndSeveralFiresAreOfEachFireItself) {
  ForecastStatistics statistics;
  const auto sure = [](double second) {
    return std::vector<ArrivalStep>{
        {at(0), 0}, {at(second), 0}, {at(second + 0.001), 1}, {at(1000), 1}};
  };
  ArrivalRecord first = arrival(0, sure(500)), second = arrival(0, sure(800));
  second.forecast.phenomenon = 1;
  statistics.arrival(first);
  statistics.arrival(second);
  statistics.truth(at(500), 0, truth(301));
  statistics.truth(at(500), 1, truth(100));
  statistics.truth(at(800), 1, truth(301));
  statistics.truth(at(1000), 0, truth(400));
  EXPECT_EQ(figures(statistics)["arrival_hut_s"], 500);
  EXPECT_NEAR(figures(statistics)["arrival_crps_mean_s"], 0, 0.01);
}

TEST(ArrivalFigures, ScoreTheDistributionAgainstWhenTheFireCame) {
  // Sure that it comes in the middle of 1,000 s; it does.
  ForecastStatistics sure;
  sure.arrival(arrival(0, {{at(0), 0}, {at(500), 0}, {at(500.001), 1}, {at(1000), 1}}));
  sure.truth(at(400), 0, truth(290));
  sure.truth(at(500), 0, truth(301));
  EXPECT_FALSE(figures(sure).contains("arrival_crps_mean_s")) << "it is not over yet";
  sure.truth(at(1000), 0, truth(350));
  EXPECT_EQ(figures(sure)["arrival_hut_s"], 500);
  EXPECT_NEAR(figures(sure)["arrival_crps_mean_s"], 0, 0.01);

  // Knows nothing: one half at all times scores a quarter of the time.
  ForecastStatistics unsure;
  unsure.arrival(arrival(0, {{at(0), 0.5}, {at(1000), 0.5}}));
  unsure.truth(at(1000), 0, truth(200));
  EXPECT_NEAR(figures(unsure)["arrival_crps_mean_s"], 250, 1e-9);
  EXPECT_FALSE(figures(unsure).contains("arrival_hut_s")) << "it never came";

  // Grows evenly, and the fire comes at once: the integral of (1 - t)^2.
  ForecastStatistics late;
  late.arrival(arrival(0, {{at(0), 0}, {at(1000), 1}}));
  late.truth(at(0), 0, truth(350));
  late.truth(at(1000), 0, truth(350));
  EXPECT_NEAR(figures(late)["arrival_crps_mean_s"], 1000.0 / 3, 1e-9);
}

}  // namespace
}  // namespace skein::record::forecast_statistics_test
