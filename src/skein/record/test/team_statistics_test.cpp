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
  team.add_figures(figures);
  EXPECT_EQ(figures.count("team_allocations_proposed"), 0u);
  for (const AllocationState state :
       {AllocationState::kWaits, AllocationState::kRejected, AllocationState::kWaits,
        AllocationState::kApproved, AllocationState::kTakenOver}) {
    report.state = state;
    team.allocation(report);
  }
  team.add_figures(figures);
  EXPECT_EQ(figures.at("team_allocations_proposed"), 2);
  EXPECT_EQ(figures.at("team_allocations_approved"), 1);
  EXPECT_EQ(figures.at("team_allocations_rejected"), 1);
  EXPECT_EQ(figures.at("team_allocations_taken_over"), 1);
}

}  // namespace
}  // namespace skein::record::team_statistics_test
