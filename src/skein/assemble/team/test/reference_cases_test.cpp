// Answers against those of other programs: ../shared/data/team/allocation.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "skein/assemble/team/team_answers.h"
#include "skein/assemble/team/team_cases.h"

namespace skein::assemble::reference_cases_test {
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
      allocation::Effort effort;
      effort.prove = true;
      const TeamAnswer found = answer(one, effort);
      EXPECT_TRUE(found.quality.proven) << one.id;
      // 1e-6: to which the optimum is known.
      EXPECT_NEAR(found.quality.value, optimum[one.id], 1e-6) << one.id;
      EXPECT_GE(found.quality.value, greedy[one.id] - 1e-6) << one.id;
    }
  }
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
    allocation::Effort effort;
    effort.iterations = 500'000;  // a second each
    const TeamAnswer found = answer(cases.value()[k], effort);
    EXPECT_LE(found.quality.value, 1.015 * std::stod(row["best_longest_tour"]))
        << found.id;
    EXPECT_GE(found.quality.bound, std::stod(row["lower_bound"]) - 1e-4);
  }
}

}  // namespace
}  // namespace skein::assemble::reference_cases_test
