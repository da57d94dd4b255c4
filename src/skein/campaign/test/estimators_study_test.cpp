// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/estimators/estimators_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "skein/base/check.h"
#include "skein/campaign/estimators/estimators_report.h"

namespace skein::campaign::estimators_study_test {
namespace {

const CurveTable& table(const std::vector<CurveTable>& tables, const std::string& name) {
  for (const CurveTable& one : tables)
    if (one.name == name) return one;
  throw std::invalid_argument(name);
}

const std::vector<double>& column(const CurveTable& one, const std::string& name) {
  for (const Curve& c : one.columns)
    if (c.name == name) return c.values;
  throw std::invalid_argument(name);
}

EstimatorsStudyOptions fire_sized() {
  EstimatorsStudyOptions options;
  options.sigma = 104;
  options.sigma_v = 10;
  return options;
}

TEST(EstimatorsStudy, QkfLiesOnTheExactCurve) {
  const auto tables = estimators_study(fire_sized());
  for (const char* side : {"above", "below"}) {
    const CurveTable& mean = table(tables, std::string("mean_") + side);
    const CurveTable& variance = table(tables, std::string("variance_") + side);
    for (std::size_t i = 0; i < column(mean, "bound_m").size(); ++i) {
      // Simpson's rule with steps below 1/200 sigma errs by less than 1e-10.
      EXPECT_NEAR(column(mean, "qkf_m")[i], column(mean, "exact_m")[i], 1e-7);
      EXPECT_NEAR(column(variance, "qkf_m2")[i] / column(variance, "exact_m2")[i], 1,
                  1e-8);
    }
  }
}

TEST(EstimatorsStudy, ApproximationsAreNeverBetterThanQkf) {
  const auto tables = estimators_study(fire_sized());
  for (const char* side : {"above", "below"}) {
    const CurveTable& variance = table(tables, std::string("variance_") + side);
    for (const char* name : {"mle_m2", "map_m2", "ukf_m2"})
      for (std::size_t i = 0; i < column(variance, name).size(); ++i)
        EXPECT_GE(column(variance, name)[i], column(variance, "qkf_m2")[i] * (1 - 1e-12));
  }
}

TEST(EstimatorsStudy, BothSidesAreMirrorImages) {
  const auto tables = estimators_study(fire_sized());
  const CurveTable& above = table(tables, "mean_above");
  const CurveTable& below = table(tables, "mean_below");
  for (std::size_t c = 1; c < above.columns.size(); ++c) {
    const auto& up = above.columns[c].values;
    const auto& down = below.columns[c].values;
    for (std::size_t i = 0; i < up.size(); ++i)
      EXPECT_NEAR(up[i], -down[down.size() - 1 - i], 1e-9) << above.columns[c].name;
  }
}

TEST(EstimatorsStudy, TakesFurtherUpdates) {
  EstimatorsStudyOptions options = fire_sized();
  options.steps = 2;
  options.more = {
      {"mine",
       [](double mean, double variance, double bound, model::Side side, double sigma_v) {
         EXPECT_EQ(mean, 0);
         EXPECT_EQ(sigma_v, 10);
         return model::Moments{side == model::Side::kAbove ? bound : -bound, variance};
       }}};
  const auto tables = estimators_study(options);
  EXPECT_EQ(column(table(tables, "mean_above"), "mine_m")[2], 416);
  EXPECT_EQ(column(table(tables, "mean_below"), "mine_m")[2], -416);
  EXPECT_EQ(column(table(tables, "variance_above"), "mine_m2")[0], 104 * 104);
}

TEST(EstimatorsStudy, GainA15ClaimsLessThanItsTrueError) {
  const auto tables = estimators_study({});
  const CurveTable& gain = table(tables, "gain_a15");
  const auto& claimed = column(gain, "claimed_variance_m2");
  const auto& real = column(gain, "true_square_error_m2");
  for (std::size_t i = 0; i < claimed.size(); ++i) EXPECT_LT(claimed[i], real[i]) << i;
  // Bound 0 is in the middle: the printed row [0, inf), four digits.
  EXPECT_NEAR(claimed[80], 0.2665, 6e-5);
  EXPECT_NEAR(real[80], 0.4086, 6e-5);
}

TEST(EstimatorsStudy, TablesAreCompleteAndWritable) {
  EstimatorsStudyOptions options;
  options.steps = 2;
  const auto tables = estimators_study(options);
  ASSERT_EQ(tables.size(), 5u);
  for (const CurveTable& one : tables)
    for (const Curve& c : one.columns) {
      ASSERT_EQ(c.values.size(), 3u) << one.name << " " << c.name;
      for (double value : c.values) EXPECT_TRUE(std::isfinite(value));
    }
  std::ostringstream out;
  write_csv(tables[0], out);
  const std::string text = out.str();
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "bound_m,exact_m,qkf_m,mle_m,map_m,ukf_m,qkf_a15_m");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
}

const record::StudyPlot& plot_of(const record::StudyReport& report,
                                 const std::string& start) {
  for (const record::StudyPlot& plot : report.plots)
    if (plot.title.starts_with(start)) return plot;
  throw std::invalid_argument(start);
}

TEST(EstimatorsReport, DrawsTheExactCurveLastAndDashed) {
  const auto report = estimators_report(estimators_study({}), 1);
  EXPECT_EQ(report.plots.size(), 5u);
  for (const record::StudyPlot& plot : report.plots) {
    EXPECT_TRUE(plot.series.back().dashed) << plot.title;
    EXPECT_TRUE(plot.series.back().name.starts_with("exact")) << plot.title;
    EXPECT_FALSE(plot.series.front().dashed);
    EXPECT_EQ(plot.x_label, "bound [m] (sigma of the prior: 1 m)");
  }
  EXPECT_EQ(plot_of(report, "Mean of a range known to be above").y_label,
            "mean of the range [m]");
  EXPECT_EQ(plot_of(report, "Variance of a range known to be above").y_label,
            "variance of the range [m²]");
}

TEST(EstimatorsReport, OneCurveDoesNotFlattenTheOthers) {
  const auto report = estimators_report(estimators_study({}), 1);
  const record::StudyPlot& plot =
      plot_of(report, "Variance of a range known to be above");
  EXPECT_GT(plot.y_high, 1) << "the prior's variance is in the picture";
  EXPECT_LT(plot.y_high, 3) << "mle goes up to 15";
  EXPECT_NE(plot.caption.find("mle leaves the picture"), std::string::npos)
      << plot.caption;
}

TEST(EstimatorsStudy, RefusesOptionsOutOfRange) {
  EstimatorsStudyOptions options;
  options.sigma = 0;
  EXPECT_THROW((void)estimators_study(options), Bug);
}

}  // namespace
}  // namespace skein::campaign::estimators_study_test
