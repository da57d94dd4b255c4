// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/batch.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "skein/base/check.h"

namespace skein::campaign::batch_test {
namespace {

class BatchTest : public testing::Test {
 protected:
  BatchTest() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "batch-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    options_.journal = folder_ / "runs.jsonl";
    options_.program = "1";
    for (int i = 0; i < 20; ++i)
      items_.push_back({"run-" + std::to_string(i), {}, "text " + std::to_string(i), ""});
  }
  ~BatchTest() override { std::filesystem::remove_all(folder_); }

  Result<record::RunSummary> run(const BatchItem& item) {
    ++runs_;
    record::RunSummary summary;
    summary.version = "1";
    summary.name = item.name;
    summary.content_hash = "h-" + item.text;
    summary.warnings = {"repaired"};
    summary.numbers["length"] = static_cast<double>(item.text.size());
    return summary;
  }
  RunScenario runner() {
    return [this](const BatchItem& item) { return run(item); };
  }

  std::filesystem::path folder_;
  BatchOptions options_;
  std::vector<BatchItem> items_;
  std::atomic<int> runs_{0};
};

TEST_F(BatchTest, GivesOutcomesInTheOrderOfTheItems) {
  options_.threads = 4;
  const auto outcomes = run_batch(items_, runner(), options_);
  ASSERT_TRUE(outcomes.ok());
  for (std::size_t i = 0; i < items_.size(); ++i)
    EXPECT_EQ(outcomes.value()[i].summary->content_hash, "h-" + items_[i].text);
}

TEST_F(BatchTest, GoesOnWhereItWas) {
  const std::vector<BatchItem> some(items_.begin(), items_.begin() + 12);
  ASSERT_TRUE(run_batch(some, runner(), options_).ok());
  std::ofstream(options_.journal, std::ios::app) << "{\"name\": \"cut o";  // killed here
  runs_ = 0;
  const auto outcomes = run_batch(items_, runner(), options_);
  ASSERT_TRUE(outcomes.ok());
  EXPECT_EQ(runs_, 8);
  EXPECT_EQ(outcomes.value()[3].summary->content_hash, "h-text 3");
  EXPECT_EQ(outcomes.value()[3].summary->number("length"), 6);
  EXPECT_EQ(outcomes.value()[3].summary->warnings.size(), 1u);
}

TEST_F(BatchTest, RunsAgainWhatChanged) {
  ASSERT_TRUE(run_batch(items_, runner(), options_).ok());
  runs_ = 0;
  items_[5].text = "changed";
  ASSERT_TRUE(run_batch(items_, runner(), options_).ok());
  EXPECT_EQ(runs_, 1);
  items_[6].data = "other data";
  ASSERT_TRUE(run_batch(items_, runner(), options_).ok());
  EXPECT_EQ(runs_, 2);
  options_.program = "2";
  ASSERT_TRUE(run_batch(items_, runner(), options_).ok());
  EXPECT_EQ(runs_, 22);
}

TEST_F(BatchTest, KeepsGoingAfterAnError) {
  const auto outcomes = run_batch(
      items_,
      [&](const BatchItem& item) -> Result<record::RunSummary> {
        SKEIN_CHECK(item.name != "run-3");
        if (item.name == "run-5") throw std::bad_alloc();
        if (item.name == "run-4") return Error{ErrorCode::kBadInput, "x", "wrong.", ""};
        return run(item);
      },
      options_);
  ASSERT_TRUE(outcomes.ok());
  EXPECT_NE(outcomes.value()[3].error, "");
  EXPECT_EQ(outcomes.value()[4].error, "x: wrong.");
  EXPECT_EQ(outcomes.value()[5].error, "not enough memory.");
  EXPECT_TRUE(outcomes.value()[6].summary);
}

TEST_F(BatchTest, StopsWhenAsked) {
  std::atomic<bool> stop{false};
  options_.stop = &stop;
  const auto outcomes = run_batch(
      items_,
      [&](const BatchItem& item) {
        if (runs_ == 4) stop = true;
        return run(item);
      },
      options_);
  ASSERT_TRUE(outcomes.ok());
  EXPECT_EQ(runs_, 5);
  EXPECT_FALSE(outcomes.value()[10].summary);
  EXPECT_EQ(outcomes.value()[10].error, "");
}

TEST_F(BatchTest, SaysWhenTheJournalCannotBeWritten) {
  options_.journal = folder_ / "no" / "such" / "folder.jsonl";
  EXPECT_FALSE(run_batch(items_, runner(), options_).ok());
  EXPECT_EQ(runs_, 0) << "results would be lost";
}

TEST_F(BatchTest, TheJournalMayBeALinkAndNothingElseThanAFile) {
  std::ofstream(folder_ / "kept.jsonl");
  std::filesystem::create_symlink("kept.jsonl", options_.journal);
  ASSERT_TRUE(run_batch(items_, runner(), options_).ok());
  EXPECT_TRUE(std::filesystem::is_symlink(options_.journal));
  EXPECT_GT(std::filesystem::file_size(folder_ / "kept.jsonl"), 1000U);
  ASSERT_TRUE(run_batch(items_, runner(), options_).ok());
  EXPECT_EQ(runs_, 20);
  options_.journal = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(options_.journal.c_str(), 0600), 0);
  const auto refused = run_batch(items_, runner(), options_);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().place, options_.journal.string());
}

TEST(MeanInterval, MatchesStudentsT) {
  const std::vector<double> values = {1, 2, 3, 4, 5, 6};
  const MeanInterval interval = mean_interval(values);
  EXPECT_DOUBLE_EQ(interval.mean, 3.5);
  // sd = 1.8708, / sqrt(6) = 0.76376, times t(5) = 2.571.
  EXPECT_NEAR(interval.half_width, 2.571 * 0.763763, 1e-5);
  EXPECT_EQ(mean_interval(std::vector<double>{7}).half_width, 0);
  EXPECT_EQ(mean_interval({}).count, 0);
}

}  // namespace
}  // namespace skein::campaign::batch_test
