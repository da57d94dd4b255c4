#include "campaign/tuning_study.h"

#include <gtest/gtest.h>

#include "campaign/tuning_report.h"

namespace skein::campaign {
namespace {

record::RunSummary flight(std::initializer_list<double> cross_track, int laps) {
  record::RunSummary summary;
  summary.content_hash = "abc";
  summary.numbers["laps"] = laps;
  int lap = 0;
  for (const double value : cross_track) {
    const std::string prefix = "lap" + std::to_string(++lap) + "_";
    summary.numbers[prefix + "cross_track_rms_m"] = value;
    summary.numbers[prefix + "height_rms_m"] = 0.5;
    summary.numbers[prefix + "airspeed_rms_mps"] = 0.5;
    summary.numbers[prefix + "effort_deg_per_s"] = 10;
  }
  return summary;
}

struct Two {
  Two() {
    study.sets = {{"soft", ""}, {"stiff", ""}};
    study.seeds = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      BatchItem item;
      item.scenario.seed = 7 + k;
      plan.items.push_back(item);
      plan.flights.push_back({k, k % 2 == 0 ? std::vector<std::size_t>{0, 1}
                                            : std::vector<std::size_t>{1, 0}});
    }
    outcomes.resize(3);
    outcomes[0].summary = flight({2, 1}, 2);
    outcomes[1].summary = flight({1.5, 3}, 2);
    outcomes[2].summary = flight({4}, 1);  // crashed in its second lap
  }
  TuningStudy study;
  TuningPlan plan;
  std::vector<BatchOutcome> outcomes;
};

TEST(TuningStudy, CostsAreSumsOfSquaresAndLapsNotFlownAreDear) {
  const record::RunSummary summary = flight({2, 1}, 2);
  EXPECT_DOUBLE_EQ(lap_cost(summary, 0), 4 + 0.25 + 0.25 + 0.25);
  EXPECT_DOUBLE_EQ(lap_cost(summary, 2), 1000);
  EXPECT_DOUBLE_EQ(flight_cost(summary), (4.75 + 1.75 + 1000) / 3);
}

TEST(TuningStudy, FiguresFollowTheGainsThroughTheLaps) {
  const Two two;
  EXPECT_EQ(values_of(two.plan, two.outcomes, 0, "cross_track_rms_m"),
            (std::vector<double>{2, 3, 4}));
  EXPECT_EQ(values_of(two.plan, two.outcomes, 1, "cross_track_rms_m"),
            (std::vector<double>{1, 1.5}));
  EXPECT_EQ(values_of(two.plan, two.outcomes, 1, "cost").back(), 1000);
  const StudyFigures figures = tuning_figures(two.study, two.plan, two.outcomes);
  EXPECT_EQ(figures.at("runs"), 3);
  EXPECT_DOUBLE_EQ(figures.at("soft/cross_track_rms_m"), 3);
  EXPECT_EQ(figures.at("stiff/laps"), 2);
  const std::string csv = tuning_csv(two.study, two.plan, two.outcomes);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6);
  EXPECT_NE(csv.find("8,1,stiff,abc,3,1.5,"), std::string::npos) << csv;
}

TEST(TuningStudy, TheReportSaysHowCertainASearchIs) {
  Two two;
  two.outcomes[2].summary = flight({4, 1}, 2);
  TuningSearch search;
  search.keys = {"lateral.l2_time_s"};
  search.start = {2.5};
  TuningFound found;
  found.search.tries = {{{2.5}, 3.0}, {{2.0}, 2.0}};
  found.search.best = found.search.tries.back();
  record::StudyReport report = tuning_report(two.study, two.plan, two.outcomes, 0, {});
  add_search(search, found, two.study, two.plan, two.outcomes, report);
  // Costs 3, 6.75 and 15 less: sd 6.139, Student's t 4.303 for two degrees of freedom.
  EXPECT_NE(report.intro.back().find("changes by -8.250 ± 15.251"), std::string::npos)
      << report.intro.back();
  EXPECT_NE(report.intro.back().find("no difference that would be certain"),
            std::string::npos);
  StudyFigures figures;
  add_search_figures(found, two.plan, two.outcomes, figures);
  EXPECT_NEAR(figures.at("search/cost_change"), -8.25, 1e-12);
  EXPECT_EQ(figures.at("search/tried"), 2);
}

}  // namespace
}  // namespace skein::campaign
