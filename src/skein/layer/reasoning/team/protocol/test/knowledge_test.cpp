// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/knowledge.h"

#include <gtest/gtest.h>

namespace skein::reasoning::knowledge_test {
namespace {

constexpr EntityId kLow{2}, kHigh{6};

TeamTask task(std::uint32_t number, bool done = false,
              std::optional<EntityId> branch = std::nullopt) {
  TeamTask made;
  made.number = number;
  made.done = done;
  made.branch = branch;
  return made;
}

TeamKnowledge of(const std::vector<TeamTask>& tasks) {
  TeamKnowledge knowledge;
  knowledge.submit(tasks);
  return knowledge;
}

TEST(TeamKnowledge, IsNotUndoneByAMasterThatKnowsLess) {
  TeamKnowledge knowledge = of({task(1, true, kLow), task(2), task(3)});
  knowledge.take(of({task(1), task(2, true)}).part(0, {}));
  EXPECT_TRUE(knowledge.tasks.at(1).done);
  EXPECT_EQ(knowledge.tasks.at(1).branch, kLow);
  EXPECT_TRUE(knowledge.tasks.at(2).done);
  EXPECT_TRUE(knowledge.tasks.contains(3));
}

TEST(TeamKnowledge, SaysWhatTheMasterDoesNotKnowUntilItDoes) {
  TeamKnowledge knowledge = of({task(1, true), task(2), task(3)});
  TeamKnowledge master = of({task(1), task(2)});
  EXPECT_TRUE(knowledge.news().tasks.empty()) << "nothing was heard of the master yet";
  knowledge.take(master.part(0, {}));
  EXPECT_EQ(knowledge.news().number, knowledge.number());
  EXPECT_EQ(knowledge.news().tasks, (std::vector<TeamTask>{task(1, true), task(3)}));
  master.add(knowledge.news(), std::nullopt);
  EXPECT_EQ(master.number(), knowledge.number());
  knowledge.take(master.part(0, {}));
  EXPECT_TRUE(knowledge.news().tasks.empty());
}

TEST(TeamKnowledge, AnOrderToDoWhatIsDoneIsNewsToTheMaster) {
  TeamKnowledge knowledge = of({task(1, true), task(2)});
  const std::vector<TeamTask> ordered = {task(1), task(2)};
  knowledge.compare(ordered);
  EXPECT_EQ(knowledge.news().tasks, std::vector<TeamTask>{task(1, true)});
  knowledge.forget_leader();
  EXPECT_TRUE(knowledge.news().tasks.empty());
}

TEST(TeamKnowledge, ASplitDividesTasksAndKeepsWhatIsDone) {
  TeamKnowledge knowledge = of({task(1, true), task(2), task(3)});
  const std::vector<TeamTask> divided = {task(1, false, kLow), task(2, false, kHigh)};
  knowledge.divide(divided);
  EXPECT_EQ(knowledge.tasks.at(1), task(1, true, kLow));
  EXPECT_EQ(knowledge.tasks.at(2), task(2, false, kHigh));
  EXPECT_EQ(knowledge.tasks.at(3), task(3)) << "the other one did not know it";
}

TEST(TeamKnowledge, NewTasksBelongToTheBranchThatHearsOfThem) {
  TeamKnowledge knowledge = of({task(1)});
  knowledge.add(of({task(1, false, kHigh), task(2)}).part(0, {}), kLow);
  EXPECT_EQ(knowledge.tasks.at(1).branch, kHigh) << "known before, divided since";
  EXPECT_EQ(knowledge.tasks.at(2).branch, kLow);
}

TEST(TeamKnowledge, ATaskThatTwoBranchesClaimIsThatOfTheLower) {
  TeamKnowledge low = of({task(1, false, kLow), task(2)});
  TeamKnowledge high = of({task(1, false, kHigh), task(2, true), task(3)});
  const TeamState of_low = low.part(0, {});
  EXPECT_TRUE(low.add_of_branch(high.part(0, {}), kHigh, kLow));
  EXPECT_TRUE(high.add_of_branch(of_low, kLow, kHigh));
  for (const TeamKnowledge* each : {&low, &high}) {
    EXPECT_EQ(each->tasks.at(1).branch, kLow);
    EXPECT_EQ(each->tasks.at(2).branch, kLow);
    EXPECT_TRUE(each->tasks.at(2).done);
  }
  EXPECT_EQ(low.tasks.at(3).branch, kHigh);
  EXPECT_FALSE(low.add_of_branch(high.part(0, {}), kHigh, kLow)) << "nothing is new";
}

}  // namespace
}  // namespace skein::reasoning::knowledge_test
