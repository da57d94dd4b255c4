// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/study_summary.h"

#include <gtest/gtest.h>

namespace skein::campaign::study_summary_test {
namespace {

BatchOutcome outcome(double perf, double wall) {
  record::RunSummary summary;
  summary.numbers = {{"perf_mean_m", perf}, {"wall_s", wall}};
  return {summary, ""};
}

TEST(StudySummary, HasMeanAndIntervalOfEveryCell) {
  StudyPlan plan;
  plan.cells = {{"calm", "joint", "sweep", {0, 1, 2}}, {"calm", "qkf", "gus", {3, 4}}};
  const std::vector<BatchOutcome> outcomes{
      outcome(4, 1), outcome(5, 2), outcome(6, 3), {std::nullopt, "failed"}, {}};
  const StudyFigures figures = study_figures(plan, outcomes);
  EXPECT_DOUBLE_EQ(figures.at("calm/sweep/joint/perf_mean_m"), 5);
  // Student's t for two degrees of freedom: 4.3027 * 1 / sqrt(3).
  EXPECT_NEAR(figures.at("calm/sweep/joint/perf_mean_m_ci95"), 2.4841, 1e-3);
  EXPECT_EQ(figures.at("runs"), 3);
  EXPECT_EQ(figures.at("runs_failed"), 1);
  EXPECT_EQ(figures.at("runs_missing"), 1);
  EXPECT_EQ(figures.at("calm/sweep/joint/runs"), 3);
  EXPECT_EQ(figures.at("calm/gus/qkf/runs"), 0);
  EXPECT_EQ(figures.size(), 7u) << "nothing of the machine, nothing of failed runs";
}

TEST(StudySummary, ComparesColumnsWithTheExactOne) {
  const std::vector<CurveTable> tables{
      {"variance",
       "Variance",
       {{"bound_m", {0, 1}}, {"exact_m2", {2, 3}}, {"qkf_a15_m2", {2, 2.5}}}},
      {"other", "No exact column", {{"bound_m", {0}}, {"claimed_m", {1}}}}};
  EXPECT_EQ(study_figures(tables),
            (StudyFigures{{"variance/qkf_a15_max_error_m2", 0.5}}));
}

TEST(StudySummary, ComparesEveryRuleOfTheEstimatorsStudy) {
  const auto tables = estimators_study({});
  const StudyFigures figures = study_figures(tables);
  // The updates are exact for the QKF; Simpson's rule errs by less than 1e-10.
  EXPECT_LT(figures.at("mean_above/qkf_max_error_m"), 1e-8);
  EXPECT_LT(figures.at("variance_below/qkf_max_error_m2"), 1e-8);
  // Two sigma points clipped at the bound are far from right 4 sigma out.
  EXPECT_GT(figures.at("mean_above/ukf_max_error_m"), 0.1);
}

}  // namespace
}  // namespace skein::campaign::study_summary_test
