// SPDX-License-Identifier: Apache-2.0
#include "app/team/rehearsal/rehearsal.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/team/rehearsal/expected_teams.h"

namespace skein::rehearsal::rehearsal_test {
namespace {

std::vector<TeamScript> reference_scripts() {
  std::ifstream in(SKEIN_SHARED_DATA "/team/protocol/scripts.json", std::ios::binary);
  if (!in) return {};
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto read = read_team_scripts(text, "scripts.json");
  EXPECT_TRUE(read) << read.error().text();
  return read ? read.value() : std::vector<TeamScript>();
}

TEST(TeamRehearsal, RulesGiveTheTeamsOfTheReferenceScripts) {
  const auto scripts = reference_scripts();
  if (scripts.empty()) GTEST_SKIP() << "without ../shared/data/team/protocol";
  for (const TeamScript& script : scripts) {
    const auto expected = expected_teams(script);
    for (const TeamExpectation& reference : script.expect) {
      const TeamExpectation* last = &expected.front();
      for (const TeamExpectation& one : expected)
        if (one.time <= reference.time) last = &one;
      EXPECT_EQ(last->groups, reference.groups) << script.id << " " << reference.time;
    }
  }
}

TEST(TeamRehearsal, EndsInTheTeamsOfTheReferenceScripts) {
  const auto scripts = reference_scripts();
  if (scripts.empty()) GTEST_SKIP() << "without ../shared/data/team/protocol";
  for (const TeamScript& script : scripts) {
    const auto result = rehearse(script, {}, {});
    EXPECT_EQ(result.met, result.expectations) << result.first_missed;
    EXPECT_EQ(result.violations, 0) << result.first_violation;
    // T_lost, the time until the successor is sure, and a query.
    for (const double settling : result.settling) EXPECT_LE(settling, 15) << script.id;
  }
}

TEST(TeamRehearsal, EndsThereWithThreeInTenMessagesLost) {
  const auto scripts = reference_scripts();
  if (scripts.empty()) GTEST_SKIP() << "without ../shared/data/team/protocol";
  TeamRehearsalOptions options;
  options.medium.loss = 0.3;
  for (const TeamScript& script : scripts) {
    const auto result = rehearse(script, options, {});
    EXPECT_EQ(result.met, result.expectations) << result.first_missed;
    EXPECT_EQ(result.violations, 0) << result.first_violation;
  }
}

TEST(TeamRehearsal, AllHaveTasksWhateverHappens) {
  for (std::uint32_t k = 0; k < 150; ++k) {
    const auto result = rehearse(random_team_script(11, k, 8), {}, {});
    EXPECT_EQ(result.met, result.expectations) << result.first_missed;
    EXPECT_EQ(result.violations, 0) << result.first_violation;
  }
}

// Messages are lost, come late, overtake each other and come twice.
TEST(TeamRehearsal, AllHaveTasksOnABadMedium) {
  TeamRehearsalOptions options;
  options.medium = {0.2, 0.2, 0.4, 0.1};
  std::uint64_t arrived = 0;
  int met = 0, expectations = 0, violations = 0;
  std::string missed;
  for (std::uint32_t k = 0; k < 60; ++k) {
    const auto result = rehearse(random_team_script(12, k, 8), options, {});
    arrived += result.events;
    met += result.met;
    expectations += result.expectations;
    violations += result.violations;
    if (missed.empty()) missed = result.first_missed + result.first_violation;
  }
  EXPECT_GE(arrived, 100'000u);
  // At the moment of looking an order may be on its way for the third time.
  EXPECT_GE(met, expectations * 0.99) << missed;
  EXPECT_LE(violations, 1) << missed;
}

TEST(TeamRehearsal, IsTheSameAgain) {
  TeamRehearsalOptions options;
  options.medium = {0.3, 0.1, 0.2, 0.1};
  const TeamScript script = random_team_script(13, 4, 8);
  std::string first, second;
  for (std::string* rows : {&first, &second})
    rehearse(script, options,
             [&](const TeamRow& row) { *rows += team_row_csv(script.id, row); });
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, second);
}

// With 8 s for every message all takes five journeys at most, and T_lost.
TEST(TeamRehearsal, WorksWithEightSecondsOfDelay) {
  TeamRehearsalOptions options;
  options.medium.delay = 8;
  options.settled = 55;
  TeamScript changed{"late", {{2}, {4}, {6}, {8}}, 4, {}, {}, 500};
  changed.events = {
      {TeamScriptEvent::What::kPartition, 80, {}, {{{2}, {4}}, {{6}, {8}}}},
      {TeamScriptEvent::What::kHeal, 150, {}, {}},
      {TeamScriptEvent::What::kPartition, 220, {}, {{{2}, {4}}, {{6}, {8}}}},
      {TeamScriptEvent::What::kHeal, 290, {}, {}},
      {TeamScriptEvent::What::kCrash, 360, {2}, {}},
      {TeamScriptEvent::What::kJoin, 430, {1}, {}}};
  const auto result = rehearse(changed, options, {});
  EXPECT_EQ(result.met, result.expectations) << result.first_missed;
}

}  // namespace
}  // namespace skein::rehearsal::rehearsal_test
