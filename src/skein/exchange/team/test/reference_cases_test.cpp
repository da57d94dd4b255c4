// SPDX-License-Identifier: Apache-2.0
// Answers against those of other programs: ../shared/data/team/allocation.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "skein/exchange/team/team_answers.h"
#include "skein/exchange/team/team_cases.h"

namespace skein::exchange::reference_cases_test {
namespace {

namespace fs = std::filesystem;

class ReferenceCases : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(folder_)) GTEST_SKIP() << "without ../shared/data/team/allocation";
  }
  std::string text(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  // Cells by row and column name; quoted cells hold no commas that count here.
  std::vector<std::map<std::string, std::string>> table(const std::string& name) const {
    std::istringstream in(text(name));
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> rows;
    for (std::string line; std::getline(in, line);) {
      std::vector<std::string> cells(1);
      bool quoted = false;
      for (const char c : line) {
        if (c == '"')
          quoted = !quoted;
        else if (c == ',' && !quoted)
          cells.emplace_back();
        else if (c != '\r')
          cells.back() += c;
      }
      if (names.empty()) {
        names = cells;
        continue;
      }
      auto& row = rows.emplace_back();
      for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = cells[k];
    }
    return rows;
  }

  fs::path folder_ = fs::path(SKEIN_SHARED_DATA) / "team" / "allocation";
};

TEST_F(ReferenceCases, CoalitionsReachTheOptimumAndProveIt) {
  for (const bool idle : {true, false}) {
    std::map<std::string, double> optimum, greedy;
    for (auto& row : table("coalitions_optimum.csv")) {
      optimum[row["id"]] = std::stod(row[idle ? "optimum_idle" : "optimum_all"]);
      greedy[row["id"]] = std::stod(row[idle ? "greedy_idle" : "greedy_all"]);
    }
    const auto cases = read_coalition_cases(text("coalitions.json"), "coalitions", idle);
    ASSERT_TRUE(cases.ok()) << cases.error().text();
    ASSERT_EQ(cases.value().size(), optimum.size());
    for (const CoalitionCase& one : cases.value()) {
      solve::Effort effort;
      effort.prove = true;
      const TeamAnswer found = answer(one, effort);
      EXPECT_TRUE(found.quality.proven) << one.id;
      // 1e-6: to which the optimum is known.
      EXPECT_NEAR(found.quality.value, optimum[one.id], 1e-6) << one.id;
      EXPECT_GE(found.quality.value, greedy[one.id] - 1e-6) << one.id;
    }
  }
}

// Random problems of which up to 0.85 % less than the best was once called proven.
TEST_F(ReferenceCases, OfFalseProofsReachWhatIsKnownToBeBetter) {
  folder_ = folder_.parent_path() / "faults";
  if (!fs::exists(folder_)) GTEST_SKIP() << "no " << folder_;
  struct Fault {
    const char* file;
    bool idle;
    double at_least;
  };
  for (const Fault& fault : {Fault{"false-proof.json", false, 11.041577},
                             Fault{"false-proof-g1-21.json", false, 7.282803},
                             Fault{"false-proof-g3-4.json", true, 0}}) {
    const auto cases = read_coalition_cases(text(fault.file), fault.file, fault.idle);
    ASSERT_TRUE(cases.ok()) << cases.error().text();
    for (const CoalitionCase& one : cases.value()) {
      std::vector<double> values;
      for (const std::uint64_t seed : {1U, 2U, 3U}) {
        solve::Effort effort;
        effort.prove = true;
        effort.seed = seed;
        const TeamAnswer found = answer(one, effort);
        EXPECT_TRUE(found.quality.proven) << one.id;
        EXPECT_GE(found.quality.value, fault.at_least - 1e-6) << one.id;
        EXPECT_GE(found.quality.bound, found.quality.value) << one.id;
        values.push_back(found.quality.value);
      }
      // 1e-9: what a proof leaves open, relative.
      EXPECT_NEAR(values[0], values[1], 2e-8) << one.id;
      EXPECT_NEAR(values[0], values[2], 2e-8) << one.id;
    }
  }
}

// The bound that is written is rounded away from the value.
TEST(TeamAnswers, WriteBoundsThatStillBound) {
  TeamAnswer row;
  row.id = "a";
  row.quality.value = 1;
  row.quality.bound = 1.0000000001;
  EXPECT_EQ(answer_row(row, 0), "a,1.000000000,,1.000000001,0,0.000\n");
  row.quality.bound = 0.99999999995;
  EXPECT_EQ(answer_row(row, 0), "a,1.000000000,,0.999999999,0,0.000\n");
  row.quality.bound = 1;
  EXPECT_EQ(answer_row(row, 0), "a,1.000000000,,1.000000000,0,0.000\n");
}

TEST_F(ReferenceCases, RoutesReachTheOptimumAndProveIt) {
  std::map<std::string, double> optimum;
  for (auto& row : table("routes_optimum.csv"))
    optimum[row["id"]] = std::stod(row["optimum_s"]);
  const auto cases = read_sequence_cases(text("routes.json"), "routes");
  ASSERT_TRUE(cases.ok()) << cases.error().text();
  for (const SequenceCase& one : cases.value()) {
    const auto found = answer(one, {});
    ASSERT_TRUE(found.ok());
    EXPECT_TRUE(found.value().quality.proven);
    EXPECT_NEAR(found.value().quality.value, optimum[one.id], 1e-5) << one.id;
  }
}

TEST_F(ReferenceCases, DiscountedValuesReachTheBestKnown) {
  std::map<std::string, double> best;
  for (auto& row : table("discounted_optimum.csv"))
    best[row["id"]] = std::stod(row["best_known"]);
  const auto cases = read_sequence_cases(text("discounted.json"), "discounted");
  ASSERT_TRUE(cases.ok()) << cases.error().text();
  for (const SequenceCase& one : cases.value()) {
    const auto found = answer(one, {});
    ASSERT_TRUE(found.ok());
    const bool small = one.tasks.size() <= 10;
    EXPECT_EQ(found.value().quality.proven, small);
    // Of large ones nobody knows the optimum: the bar is 1 %.
    EXPECT_GE(found.value().quality.value, best[one.id] * (small ? 1 - 1e-8 : 0.99))
        << one.id;
  }
}

TEST_F(ReferenceCases, ToursReachTheBestKnown) {
  const auto rows = table("tours_best.csv");
  const auto cases =
      read_tour_cases(text("tours_points.csv"), "points", text("tours_best.csv"), "best");
  ASSERT_TRUE(cases.ok()) << cases.error().text();
  ASSERT_EQ(cases.value().size(), rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    auto row = rows[k];
    solve::Effort effort;
    effort.iterations = 500'000;  // a second each
    const TeamAnswer found = answer(cases.value()[k], effort);
    EXPECT_LE(found.quality.value, 1.015 * std::stod(row["best_longest_tour"]))
        << found.id;
    EXPECT_GE(found.quality.bound, std::stod(row["lower_bound"]) - 1e-4);
  }
}

}  // namespace
}  // namespace skein::exchange::reference_cases_test
