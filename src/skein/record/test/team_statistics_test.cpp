// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/team_statistics.h"

#include <gtest/gtest.h>

namespace skein::record::team_statistics_test {
namespace {

TEST(TeamStatistics, CountsAllocationsOnlyWhereTheyWait) {
  TeamStatistics team;
  team.lead({Time(), EntityId{1}, {"M", EntityId{1}, {{1}}, TeamReason::kSelected}});
  TeamAllocationReport report;
  report.state = AllocationState::kUnasked;
  team.allocation(report);
  std::map<std::string, double> figures;
  team.add_figures(figures, Time());
  EXPECT_EQ(figures.count("team_allocations_proposed"), 0u);
  for (const AllocationState state :
       {AllocationState::kWaits, AllocationState::kRejected, AllocationState::kWaits,
        AllocationState::kApproved, AllocationState::kTakenOver}) {
    report.state = state;
    team.allocation(report);
  }
  team.add_figures(figures, Time());
  EXPECT_EQ(figures.at("team_allocations_proposed"), 2);
  EXPECT_EQ(figures.at("team_allocations_approved"), 1);
  EXPECT_EQ(figures.at("team_allocations_rejected"), 1);
  EXPECT_EQ(figures.at("team_allocations_taken_over"), 1);
}

// Tasks that two fly at once, until the end of the run too.
TEST(TeamStatistics, CountsHowLongTwoFlyOneTask) {
  TeamStatistics team;
  team.lead({Time(), EntityId{1}, {"M", EntityId{1}, {{1}}, TeamReason::kSelected}});
  const auto says = [&](double time, std::uint32_t who, EventKind kind,
                        std::optional<std::uint32_t> task = {}) {
    team.event({Time::from_seconds(time), EntityId{who}, kind, "", {.team_task = task}});
  };
  says(1, 1, EventKind::kTeamTask, 3);
  says(10, 2, EventKind::kTeamTask, 3);
  says(14, 1, EventKind::kLeft);
  says(20, 3, EventKind::kTeamTask);
  says(20, 4, EventKind::kTeamTask);
  says(30, 5, EventKind::kTeamTask, 3);
  std::map<std::string, double> figures;
  team.add_figures(figures, Time::from_seconds(37));
  EXPECT_EQ(figures.at("team_double_max_s"), 7);
  EXPECT_EQ(figures.at("team_double_total_s"), 11);
  says(40, 2, EventKind::kAccident);
  team.add_figures(figures, Time::from_seconds(50));
  EXPECT_EQ(figures.at("team_double_max_s"), 10);
  EXPECT_EQ(figures.at("team_double_total_s"), 14);
}

}  // namespace
}  // namespace skein::record::team_statistics_test
