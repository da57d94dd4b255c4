// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/following/following_study.h"

#include <gtest/gtest.h>

namespace skein::campaign::following_study_test {
namespace {

TEST(FollowingStudy, CountsTheDistanceOfASampleAfterTheRunIn) {
  std::vector<LapSample> samples;
  for (int i = 0; i < 130; ++i) {
    LapSample s;
    s.time = 100 + i;
    // The first 30 s are far off; then -1, 2, -3, ... -99, 100.
    s.cross_track = i < 30 ? 1000 : (i % 2 == 0 ? -1 : 1) * (i - 29.0);
    samples.push_back(s);
  }
  std::map<std::string, double> figures;
  add_following_figures(samples, figures);
  EXPECT_EQ(figures.at("cross_track_q05_m"), 5);
  EXPECT_EQ(figures.at("cross_track_q50_m"), 50);
  EXPECT_EQ(figures.at("cross_track_q95_m"), 95);
  EXPECT_EQ(figures.at("cross_track_q99_m"), 99);
  EXPECT_EQ(figures.at("cross_track_max_m"), 100);
  // The sum of the first 100 squares is 338350.
  EXPECT_NEAR(figures.at("cross_track_rms_m"), std::sqrt(3383.5), 1e-9);
  std::map<std::string, double> none;
  add_following_figures({}, none);
  EXPECT_TRUE(none.empty());
}

BatchOutcome outcome(double q95) {
  record::RunSummary summary;
  summary.numbers = {{"cross_track_q95_m", q95}};
  BatchOutcome done;
  done.summary = summary;
  return done;
}

TEST(FollowingStudy, ComparesTheMeansOfBothKindsOfPlans) {
  StudyPlan plan;
  plan.items.resize(4);
  plan.cells = {{"south", "at-airspeed", "dubins", {0, 1}},
                {"south", "at-airspeed", "trochoids", {2, 3}}};
  const std::vector<BatchOutcome> outcomes = {outcome(6), outcome(10), outcome(1.5),
                                              outcome(2.5)};
  const auto ratios = following_ratios(plan, outcomes);
  EXPECT_DOUBLE_EQ(ratios.at("south/at-airspeed/times_closer_p95"), 4);
  EXPECT_TRUE(std::isnan(ratios.at("south/in-time/times_closer_p95")));
  const record::StudyReport report = following_report({}, plan, outcomes, {});
  EXPECT_EQ(std::get<std::string>(report.tables[0].rows[0][1].value), "4.0");
}

}  // namespace
}  // namespace skein::campaign::following_study_test
