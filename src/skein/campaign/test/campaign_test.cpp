// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/campaign/campaign.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "skein/scenario/kind_table.h"
#include "skein/scenario/test/fake_kinds.h"

namespace skein::campaign::campaign_test {
namespace {

namespace fs = std::filesystem;

class CampaignTest : public testing::Test {
 protected:
  CampaignTest() : folder_(fs::path(testing::TempDir()) / "campaign_test") {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "base.yaml") << "name: base\nduration_s: 10\n"
                                            "environment: {phenomena: []}\naircraft: []\n"
                                            "missions: []\n";
  }

  Result<CampaignFile> read(const std::string& text) const {
    return read_campaign_text("name: c\nscenario: base.yaml\n" + text, "c.yaml", folder_);
  }

  fs::path folder_;
  scenario::KindTable kinds_;
};

constexpr const char* kTwoAxes =
    "seeds: 3\n"
    "first_seed: 7\n"
    "axes:\n"
    "  - {name: length, variants: [{name: short}, {name: long, set: [duration_s=20]}]}\n"
    "  - {name: step, variants: [{name: fine, set: [step_s=0.01]}, {name: rough}]}\n"
    "draws: [{key: dynamics_step_s, among: [\"0.01\", \"0.005\"]}]\n"
    "figures: [{figure: perf, extreme: most}]\n";

TEST_F(CampaignTest, SaysWhatIsWrongWithAFile) {
  const auto odd = read(
      "axes: [{name: \"p/q\", variants: [{name: y}]}]\n"
      "draws: [{key: seed}, {key: step_s, between: [2, 1]}, {key: step_s, between: [1, "
      "2], "
      "among: [a]}]\n");
  ASSERT_FALSE(odd);
  const std::string text = odd.error().text();
  for (const char* part : {"must be a name", "draws follow from", "smaller one first",
                           "either between or among", "figures", "nothing was run"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  EXPECT_FALSE(read("figures: [{figure: a}]\nscenario: none.yaml"));
  const auto twice = read(
      "axes: [{name: a, variants: [{name: x}]}, {name: b, variants: [{name: x}]}]\n"
      "figures: [{figure: a}]\n");
  ASSERT_FALSE(twice);
  EXPECT_NE(twice.error().text().find("two variants are called x"), std::string::npos);
}

TEST_F(CampaignTest, RefusesAVariantThatThereIsNot) {
  const auto file = read(kTwoAxes);
  ASSERT_TRUE(file) << file.error().text();
  const auto plan = plan_campaign(file.value(), {{"longer"}, {}}, kinds_);
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().text().find("short long fine rough"), std::string::npos);
}

BatchOutcome outcome(double perf) {
  record::RunSummary summary;
  summary.numbers = {{"perf", perf}};
  return {summary, ""};
}

TEST_F(CampaignTest, ReadsItsScenarioOnceHoweverManyRunsThereAre) {
  const auto file = read(
      "seeds: 3\n"
      "axes: [{name: length, variants: [{name: short}, {name: long, set: "
      "[duration_s=20]}]}]\n"
      "draws: [{key: step_s, among: [\"0.01\", \"0.02\"]}]\n"
      "figures: [{figure: perf}]\n");
  ASSERT_TRUE(file) << file.error().text();
  const scenario::KindTable kinds = scenario::test::fake_kinds();
  const ScenarioReader reader(kinds);
  const auto first = plan_campaign(file.value(), {}, reader);
  ASSERT_TRUE(first) << first.error().text();
  // What is written meanwhile does not make two kinds of runs in one campaign.
  std::ofstream(folder_ / "base.yaml") << "nonsense: 1\n";
  const auto again = plan_campaign(file.value(), {}, reader);
  ASSERT_TRUE(again) << again.error().text();
  ASSERT_EQ(again.value().items.size(), first.value().items.size());
  for (std::size_t k = 0; k < first.value().items.size(); ++k)
    EXPECT_EQ(again.value().items[k].text, first.value().items[k].text);
  EXPECT_FALSE(plan_campaign(file.value(), {}, kinds)) << "another reader reads anew";
}

TEST_F(CampaignTest, PreparingItStopsWhenAsked) {
  const auto file = read(kTwoAxes);
  ASSERT_TRUE(file) << file.error().text();
  const std::atomic<bool> stop{true};
  const auto plan =
      plan_campaign(file.value(), {}, ScenarioReader(kinds_, {}, {}, &stop));
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::kInterrupted);
}

TEST(CampaignReport, HasARowForEachCombinationWithItsWorstRun) {
  CampaignFile file;
  file.name = "c";
  file.axes = {{"length", {{"short", "", {}}, {"long", "twice", {}}}}};
  file.figures = {{"perf", "", 2, Extreme::kMost}};
  StudyPlan plan;
  plan.dimensions = {"length", "", ""};
  plan.cells = {{"short", "", "", {0, 1}}, {"long", "", "", {2, 3}}};
  const std::vector<BatchOutcome> outcomes = {outcome(1), outcome(3), outcome(5), {}};
  const record::StudyReport report = campaign_report(file, plan, outcomes);
  EXPECT_EQ(report.alert, "partial: 3 of 4 runs");
  ASSERT_EQ(report.tables.size(), 1u);
  const auto& table = report.tables.front();
  EXPECT_EQ(table.columns, (std::vector<std::string>{"length", "runs", "perf", "most"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(std::get<std::string>(table.rows[0][2].value), "2.00 ± 12.71");
  EXPECT_EQ(std::get<std::string>(table.rows[0][3].value), "3.00");
  EXPECT_EQ(std::get<std::string>(table.rows[1][2].value), "5.00 (n = 1)");
  ASSERT_EQ(report.dots.size(), 1u);
  EXPECT_EQ(report.dots.front().series, (std::vector<std::string>{"short", "long"}));
  EXPECT_EQ(report.dots.front().dots[0][1].value, 5);
  EXPECT_EQ(report.intro, (std::vector<std::string>{"length long: twice"}));
}

}  // namespace
}  // namespace skein::campaign::campaign_test
