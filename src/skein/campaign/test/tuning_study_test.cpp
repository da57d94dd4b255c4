// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/tuning/tuning_study.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "skein/campaign/tuning/tuning_report.h"

namespace skein::campaign::tuning_study_test {
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
  EXPECT_EQ(laps_of(two.plan, two.outcomes, 1).planned, 3);
  EXPECT_EQ(laps_of(two.plan, two.outcomes, 1).completed, 2);
  EXPECT_TRUE(two.plan.flights[0].changes());
  const StudyFigures figures = tuning_figures(two.study, two.plan, two.outcomes);
  EXPECT_EQ(figures.at("runs"), 3);
  EXPECT_DOUBLE_EQ(figures.at("soft/cross_track_rms_m"), 3);
  EXPECT_EQ(figures.at("stiff/laps"), 2);
  const std::string csv = tuning_csv(two.study, two.plan, two.outcomes);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6);
  EXPECT_NE(csv.find("8,1,stiff,abc,3,1.5,"), std::string::npos) << csv;
}

// Two sets, each flown for three laps with seeds 7 and 8.
struct Compared : Two {
  Compared() {
    plan.flights = {{0, {0, 0, 0}}, {1, {0, 0, 0}}, {2, {1, 1, 1}}, {3, {1, 1, 1}}};
    plan.items.resize(4);
    for (std::size_t k = 0; k < 4; ++k) plan.items[k].scenario.seed = 7 + k % 2;
    outcomes.resize(4);
    outcomes[0].summary = flight({2, 2, 2}, 3);
    outcomes[1].summary = flight({3, 3, 3}, 3);
    outcomes[2].summary = flight({1, 1, 1}, 3);
    outcomes[3].summary = flight({2.5, 2.5, 2.5}, 3);
    search.keys = {"lateral.l2_time_s"};
    search.start = {2.5};
    found.search.tries = {{{2.5}, 3.0}, {{2.0}, 2.0}};
    found.search.best = found.search.tries.back();
  }
  std::string text() {
    auto report = tuning_report(study, plan, outcomes, {});
    add_search(search, found, study, plan, outcomes, report);
    return report.intro.back();
  }
  TuningSearch search;
  TuningFound found;
};

TEST(TuningStudy, FlightsAreComparedSeedBySeed) {
  Compared compared;
  // Per flight one value, the mean of its laps.
  EXPECT_EQ(values_of(compared.plan, compared.outcomes, 0, "cross_track_rms_m"),
            (std::vector<double>{2, 3}));
  const MeanInterval change = cost_change(compared.plan, compared.outcomes);
  EXPECT_EQ(change.count, 2);
  EXPECT_DOUBLE_EQ(change.mean, (-3 - 2.75) / 2);
  compared.outcomes[2].summary.reset();  // was not flown
  EXPECT_EQ(cost_change(compared.plan, compared.outcomes).count, 1);
  EXPECT_DOUBLE_EQ(cost_change(compared.plan, compared.outcomes).mean, -2.75);
  StudyFigures figures;
  add_search_figures(compared.found, compared.plan, compared.outcomes, figures);
  EXPECT_NEAR(figures.at("search/cost_change"), -2.75, 1e-12);
  EXPECT_FALSE(figures.contains("search/cost_change_ci95"));
  EXPECT_EQ(figures.at("search/tried"), 2);
}

TEST(TuningStudy, TheReportSaysHowCertainASearchIs) {
  Compared compared;
  // -3 and -2.75: Student's t for one degree of freedom is 12.7, so -2.875 +- 1.588.
  EXPECT_NE(compared.text().find("changes by -2.875 ± 1.588: the gains found are better"),
            std::string::npos)
      << compared.text();
  compared.outcomes[3].summary = flight({2.9, 2.9, 2.9}, 3);
  EXPECT_NE(compared.text().find("no gain that would be certain"), std::string::npos)
      << compared.text();
  compared.outcomes[2].summary.reset();
  EXPECT_NE(compared.text().find("no gain that would be certain"), std::string::npos)
      << "one flight says nothing: " << compared.text();
}

TEST(TuningStudy, DrawsEachLapOrEachFlight) {
  std::vector<LapSample> samples(6);
  for (int k = 0; k < 6; ++k) {
    samples[static_cast<std::size_t>(k)].lap = k / 3;
    samples[static_cast<std::size_t>(k)].time = k;
  }
  const Two laps;
  const auto by_lap = tuning_report(laps.study, laps.plan, laps.outcomes, {{1, samples}});
  ASSERT_EQ(by_lap.plots.size(), 1u);
  ASSERT_EQ(by_lap.plots[0].series.size(), 2u);
  EXPECT_EQ(by_lap.plots[0].series[0].name, "lap 1: stiff");
  EXPECT_EQ(by_lap.plots[0].series[1].x, (std::vector<double>{3, 4, 5}));
  EXPECT_EQ(by_lap.alert.substr(0, 35), "1 of 6 laps were not completed: the");
  EXPECT_EQ(by_lap.maps.at(0).series.size(), 3u) << "laps and the route";
  const Compared two;
  const auto by_flight =
      tuning_report(two.study, two.plan, two.outcomes, {{0, samples}, {2, samples}});
  EXPECT_EQ(by_flight.alert, "");
  ASSERT_EQ(by_flight.plots[0].series.size(), 2u);
  EXPECT_EQ(by_flight.plots[0].series[1].name, "stiff");
  EXPECT_EQ(by_flight.plots[0].series[1].x.size(), 6u);
}

}  // namespace
}  // namespace skein::campaign::tuning_study_test
