// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/test/reading.h"

#include <gtest/gtest.h>

#include "skein/scenario/test/fake_kinds.h"

namespace skein::scenario::test {

ReadOutcome read_text(std::string_view text, const std::vector<std::string>& sets) {
  std::vector<Override> overrides;
  for (const std::string& set : sets) overrides.push_back({set});
  return read_scenario_text(text, "test.yaml", SKEIN_SOURCE_DIR, fake_kinds(), overrides);
}

Scenario read_good(std::string_view text, const std::vector<std::string>& sets) {
  const ReadOutcome outcome = read_text(text, sets);
  EXPECT_EQ(outcome.report(), "");
  if (!outcome.ok()) return {};
  return *outcome.scenario;
}

std::string problems_of(std::string_view text, const std::vector<std::string>& sets) {
  const ReadOutcome outcome = read_text(text, sets);
  EXPECT_EQ(outcome.ok(), outcome.problem_count == 0);
  std::string lines;
  for (const Problem& problem : outcome.problems) lines += problem.text() + "\n";
  return lines;
}

}  // namespace skein::scenario::test
