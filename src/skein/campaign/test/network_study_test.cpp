// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/network/network_study.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "skein/campaign/network/network_reference.h"
#include "skein/campaign/network/network_report.h"

namespace skein::campaign::network_study_test {
namespace {

namespace figure = network_figure;

BatchOutcome outcome_of(std::map<std::string, double> numbers) {
  record::RunSummary summary;
  summary.numbers = std::move(numbers);
  return {summary, ""};
}

NetworkStudy small_grid() {
  NetworkStudy study = default_network_study(NetworkExperiment::kGrid);
  study.nodes = {9, 25};
  study.profiles = {"nn4"};
  study.seeds = 2;
  return study;
}

const record::StudyTable& table_named(const record::StudyReport& report,
                                      const std::string& title) {
  static const record::StudyTable none;
  for (const record::StudyTable& table : report.tables)
    if (table.title == title) return table;
  return none;
}

std::string cell_text(const record::StudyTable& table, std::size_t row,
                      std::size_t column) {
  const auto* text = std::get_if<std::string>(&table.rows.at(row).at(column).value);
  return text ? *text : "-";
}

TEST(NetworkStudy, HasACaseForEveryNetworkAccessAndSeed) {
  const auto planned = plan_network_study(small_grid());
  ASSERT_TRUE(planned.ok());
  const NetworkStudyPlan& plan = planned.value();
  ASSERT_EQ(plan.cases.size(), 8u);
  ASSERT_EQ(plan.plan.cells.size(), 4u);
  std::set<std::string> names;
  for (std::size_t i = 0; i < plan.cases.size(); ++i) {
    EXPECT_EQ(plan.plan.items[i].scenario.seed, plan.cases[i].seed);
    names.insert(plan.plan.items[i].name);
  }
  EXPECT_EQ(names.size(), 8u);
  EXPECT_EQ(plan.plan.cells[3].path(), "nn4/rts/25");
  EXPECT_TRUE(plan.of(plan.plan.cells[3]).rts);
  EXPECT_EQ(plan.of(plan.plan.cells[3]).nodes, 25u);
}

TEST(NetworkStudy, SaysWhatIsWrong) {
  const auto message = [](const NetworkStudy& study) {
    const auto planned = plan_network_study(study);
    return planned ? "" : planned.error().text();
  };
  NetworkStudy study = small_grid();
  study.nodes = {1};
  EXPECT_EQ(message(study), "--nodes: 1 is no number of nodes from 2 to 2500.");
  study.nodes = {4, 9, 4};
  EXPECT_EQ(message(study), "--nodes: 4 is named twice.");
  study = small_grid();
  study.profiles = {"nn4", "nn4"};
  EXPECT_EQ(message(study), "--profiles: \"nn4\" is named twice.");
  study = default_network_study(NetworkExperiment::kCell);
  study.duration = 1;
  EXPECT_EQ(message(study),
            "--duration: 1 s: the experiment cell lasts longer than 1 s. What happens "
            "before that does not count.");
}

TEST(NetworkStudy, IsReportedBesideTheReference) {
  const NetworkStudy study = small_grid();
  const NetworkStudyPlan planned = plan_network_study(study).value();
  std::vector<BatchOutcome> outcomes;
  for (std::size_t i = 0; i < planned.cases.size(); ++i)
    outcomes.push_back(outcome_of({{figure::kDelayMean, i % 2 == 0 ? 7.0 : 7.2},
                                   {figure::kDelayP95, 23},
                                   {figure::kLoss, 0.4},
                                   {figure::kGoodput, 360},
                                   {figure::kSimulated, 300},
                                   {figure::kCpu, 0.03}}));
  const record::StudyReport report = network_report(study, planned, outcomes);
  EXPECT_TRUE(report.alert.empty());
  EXPECT_EQ(report.plots.size(), 8u);
  const record::StudyTable& table = table_named(report, "nn4, basic access");
  ASSERT_EQ(table.rows.size(), 2u);
  // Student's t of two values 0.2 apart: 12.706 * 0.1.
  EXPECT_EQ(cell_text(table, 0, 1), "7.100 ± 1.271");
  EXPECT_EQ(cell_text(table, 0, 2), "7.018");
  EXPECT_EQ(cell_text(table, 0, 3), "+1.17");
  // 4.0167 ms of the reference against 0.1 ms.
  EXPECT_EQ(cell_text(table_named(report, "What it costs"), 0, 6), "40");

  const auto compared = network_comparison(planned, study.experiment, outcomes);
  // 7.1 against 7.0176 ms, 0.4 against 0.3654 %: the digits of the reference.
  EXPECT_NEAR(compared.at("nn4/basic/9/delay_mean_off_percent"), 1.174, 5e-4);
  EXPECT_NEAR(compared.at("nn4/basic/9/loss_off_points"), 0.0346, 5e-5);
  EXPECT_FALSE(compared.contains("nn4/basic/9/bianchi_off_percent"));

  outcomes.back() = {};
  EXPECT_EQ(network_report(study, planned, outcomes).alert, "partial: 7 of 8 runs");
}

TEST(NetworkStudy, OfACellAndAHiddenNodeIsReportedToo) {
  for (const auto experiment : {NetworkExperiment::kCell, NetworkExperiment::kHidden}) {
    NetworkStudy study = default_network_study(experiment);
    const NetworkStudyPlan planned = plan_network_study(study).value();
    // As after an interrupt before the first case is done.
    const std::vector<BatchOutcome> none(planned.cases.size());
    EXPECT_FALSE(network_report(study, planned, none).alert.empty());
    EXPECT_TRUE(network_comparison(planned, experiment, none).empty());
    const std::vector<BatchOutcome> all(planned.cases.size(),
                                        outcome_of({{figure::kGoodput, 1500},
                                                    {figure::kLoss, 1},
                                                    {figure::kCollisions, 0.1},
                                                    {figure::kBianchiGoodput, 1510},
                                                    {figure::kBianchiFiniteGoodput, 1500},
                                                    {figure::kBianchiCollisions, 0.1}}));
    const record::StudyReport report = network_report(study, planned, all);
    EXPECT_EQ(report.tables.size(), experiment == NetworkExperiment::kCell ? 3u : 2u);
    EXPECT_EQ(report.dots.size(), experiment == NetworkExperiment::kCell ? 0u : 2u);
  }
}

TEST(NetworkReference, IsKnownWhereItWasMeasured) {
  EXPECT_TRUE(grid_reference("cs91", true, 36));
  EXPECT_FALSE(grid_reference("cs91", true, 49));
  EXPECT_FALSE(grid_reference("wifi-dsss-2", false, 4));
  EXPECT_TRUE(cell_reference(false, 10));
  EXPECT_FALSE(cell_reference(false, 50));
  EXPECT_TRUE(hidden_reference("nn8", true));
}

}  // namespace
}  // namespace skein::campaign::network_study_test
