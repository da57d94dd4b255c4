// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/allocator.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "skein/layer/reasoning/team/protocol/test/lone_member.h"

namespace skein::reasoning::allocator_test {
namespace {

constexpr EntityId kStation{0}, kSelf{1}, kOther{2};

struct Display : ProposalDisplay {
  std::optional<std::uint32_t> number = {};
  void show(MemberState&, EntityId, const TeamProposal& proposal) override {
    number = proposal.number;
  }
  void end(MemberState&, EntityId, AllocationState, const char*) override {
    number.reset();
  }
};

TeamConfig asked() {
  TeamConfig config;
  config.approval = true;
  config.operators = {kStation};
  return config;
}

// A leader with workers 1, 2, ... at the places of tasks 1, 2, ...
struct Leader : LoneMember {
  TeamAllocator allocator;
  Display display;

  explicit Leader(std::uint32_t tasks, TeamConfig config = asked())
      : LoneMember(kSelf, std::move(config)) {
    state.role = TeamRole::kLeading;
    state.knowledge.submit(tasks_in_a_row(tasks));
  }
  std::vector<TeamTask> open() const { return state.knowledge.open(); }
  static std::vector<TeamWorker> workers(std::uint32_t count) {
    std::vector<TeamWorker> all;
    for (std::uint32_t k = 0; k < count; ++k) {
      all.push_back({{k + 1}, {}, {}});
      all.back().resources.place = Vec3(100.0 * k, 0, -100);
    }
    return all;
  }
  void allocate(std::uint32_t count) {
    allocator.allocate(state, display, open(), workers(count));
  }
  bool decide(std::uint32_t number, TeamAnswer answer, std::uint32_t count) {
    return allocator.settle(state, display, kStation, {number, answer}, open(),
                            workers(count));
  }
  std::set<std::uint32_t> flown() const {
    std::set<std::uint32_t> all;
    for (const auto& [id, tasks] : allocator.in_force())
      all.insert(tasks.begin(), tasks.end());
    return all;
  }
  std::vector<AllocationState> recorded() {
    std::vector<AllocationState> all;
    for (const auto& one : state.outbox.take().allocations) all.push_back(one.state);
    return all;
  }
};

using Numbers = std::set<std::uint32_t>;
using States = std::vector<AllocationState>;

TEST(TeamAllocator, WithoutApprovalAnAllocationIsInForceAtOnce) {
  Leader leader(2, TeamConfig{});
  leader.allocate(2);
  EXPECT_EQ(leader.flown(), (Numbers{1, 2}));
  EXPECT_EQ(leader.recorded(), States{AllocationState::kUnasked});
}

TEST(TeamAllocator, NothingIsFlownBeforeItIsApproved) {
  Leader leader(2);
  for (int k = 0; k < 50; ++k) {
    leader.at(k);
    leader.allocate(2);
    leader.allocator.send_proposal(leader.state);
    EXPECT_EQ(leader.flown(), Numbers{});
  }
  EXPECT_TRUE(leader.decide(1, TeamAnswer::kApprove, 2));
  EXPECT_EQ(leader.flown(), (Numbers{1, 2}));
}

TEST(TeamAllocator, WhatIsRejectedIsNeverFlown) {
  Leader leader(2);
  leader.allocate(2);
  EXPECT_FALSE(leader.decide(1, TeamAnswer::kReject, 2));
  EXPECT_FALSE(leader.decide(1, TeamAnswer::kApprove, 2)) << "it has been decided";
  leader.allocate(2);
  EXPECT_EQ(leader.flown(), Numbers{});
  EXPECT_EQ(leader.recorded(),
            (States{AllocationState::kWaits, AllocationState::kRejected}))
      << "the same is not proposed again";
}

TEST(TeamAllocator, ADecisionCountsOnceAndIsAnsweredEachTime) {
  Leader leader(2);
  leader.allocate(2);
  EXPECT_TRUE(leader.decide(1, TeamAnswer::kApprove, 2));
  EXPECT_FALSE(leader.decide(1, TeamAnswer::kApprove, 2));
  EXPECT_FALSE(leader.decide(1, TeamAnswer::kReject, 2));
  EXPECT_EQ(leader.flown(), (Numbers{1, 2}));
  const auto answers = leader.take_sent<TeamProposal>();
  ASSERT_EQ(answers.size(), 3u);
  for (const TeamProposal& answer : answers)
    EXPECT_EQ(answer.state, AllocationState::kApproved);
}

TEST(TeamAllocator, AnotherNumberApprovesNothing) {
  Leader leader(2);
  leader.allocate(2);
  EXPECT_FALSE(leader.decide(2, TeamAnswer::kApprove, 2));
  EXPECT_FALSE(leader.decide(0, TeamAnswer::kApprove, 2));
  EXPECT_FALSE(leader.decide(1, TeamAnswer::kSeen, 2));
  EXPECT_EQ(leader.flown(), Numbers{});
}

TEST(TeamAllocator, AWithdrawnProposalCannotBeApproved) {
  Leader leader(1);
  leader.allocate(2);
  leader.state.knowledge.submit(tasks_in_a_row(2));  // another task has come
  leader.allocate(2);
  EXPECT_FALSE(leader.decide(1, TeamAnswer::kApprove, 2));
  EXPECT_EQ(leader.flown(), Numbers{});
  EXPECT_EQ(leader.take_sent<TeamProposal>().back().state, AllocationState::kWithdrawn);
  EXPECT_TRUE(leader.decide(2, TeamAnswer::kApprove, 2));
  EXPECT_EQ(leader.flown(), (Numbers{1, 2}));
}

TEST(TeamAllocator, ApprovedTasksAndMembersThatAreGoneAreNotFlown) {
  Leader leader(3);
  leader.allocate(3);
  leader.state.knowledge.finish(1);
  EXPECT_TRUE(leader.decide(1, TeamAnswer::kApprove, 2)) << "the third member is lost";
  EXPECT_EQ(leader.flown(), Numbers{2});
}

TEST(TeamAllocator, OnlyApprovedTasksAreTakenOver) {
  Leader leader(2);
  leader.allocate(2);
  leader.decide(1, TeamAnswer::kApprove, 2);
  leader.state.knowledge.submit(tasks_in_a_row(0));
  leader.state.knowledge.tasks[3] = tasks_in_a_row(3).back();
  leader.recorded();
  // Member 2 is lost, 3 is idle: it gets task 2, and not the new one.
  auto workers = Leader::workers(3);
  workers.erase(workers.begin() + 1);
  leader.allocator.allocate(leader.state, leader.display, leader.open(), workers);
  EXPECT_EQ(leader.flown(), (Numbers{1, 2}));
  EXPECT_EQ(leader.allocator.in_force().at(EntityId{3}), std::vector<std::uint32_t>{2});
  EXPECT_EQ(leader.recorded().front(), AllocationState::kTakenOver);
}

TEST(TeamAllocator, ALeaderWithAnOperatorShowsItsProposalsThere) {
  TeamConfig config = asked();
  config.operators = {};
  config.fixed_leader = kSelf;
  Leader leader(1, config);
  leader.allocate(1);
  EXPECT_EQ(leader.display.number, 1u);
  EXPECT_TRUE(leader.allocator.settle(leader.state, leader.display, kSelf,
                                      {1, TeamAnswer::kApprove}, leader.open(),
                                      Leader::workers(1)));
  EXPECT_FALSE(leader.display.number);
}

TEST(TeamAllocator, IsDueWhenTheOwnAbilityHasChanged) {
  Leader leader(1);
  leader.allocator.look(leader.state);
  EXPECT_FALSE(leader.state.allocation_due);
  leader.state.own.set_resources({.able = false});
  leader.allocator.look(leader.state);
  EXPECT_TRUE(leader.state.allocation_due);
}

// Whatever comes, goes and is decided: what is flown was approved.
TEST(TeamAllocator, NeverFliesWhatWasNotApproved) {
  EXPECT_TRUE(rc::check("all that is flown was approved", [] {
    Leader leader(static_cast<std::uint32_t>(*rc::gen::inRange(1, 5)));
    Numbers approved;
    std::map<std::uint32_t, Numbers> proposed;
    std::uint32_t next_task = 10;
    for (int k = 0; k < 40; ++k) {
      leader.at(k);
      const auto count = static_cast<std::uint32_t>(*rc::gen::inRange(0, 5));
      const auto number = static_cast<std::uint32_t>(*rc::gen::inRange(1, 8));
      switch (*rc::gen::inRange(0, 5)) {
        case 0:
          leader.state.knowledge.tasks[next_task].number = next_task;
          ++next_task;
          break;
        case 1:
          leader.state.knowledge.finish(number);
          break;
        case 2:
          leader.decide(number, TeamAnswer::kReject, count);
          break;
        case 3:
          if (leader.decide(number, TeamAnswer::kApprove, count))
            approved.merge(proposed[number]);
          break;
        default:
          leader.allocate(count);
      }
      for (const auto& one : leader.state.outbox.take().allocations)
        if (one.state == AllocationState::kWaits)
          for (const TeamShare& share : one.shares)
            proposed[one.number].insert(share.task);
      for (const std::uint32_t task : leader.flown()) {
        RC_ASSERT(approved.contains(task));
        RC_ASSERT(leader.state.knowledge.tasks.at(task).released);
      }
    }
  }));
}

}  // namespace
}  // namespace skein::reasoning::allocator_test
