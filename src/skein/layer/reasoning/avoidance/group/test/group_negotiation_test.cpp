// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/group/group_negotiation.h"

#include <gtest/gtest.h>

#include <random>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/group/test/circle_of_flights.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/said_limits.h"

namespace skein::reasoning::group_negotiation_test {
namespace {

// Members of a group and the network between them; the first one coordinates.
class SmallGroup {
 public:
  SmallGroup(int count, double loss, unsigned seed)
      : plans_(circle_of_flights(count)), loss_(loss), random_(seed) {
    GroupInvitation invitation;
    invitation.group = 1;
    invitation.begin = 15;
    invitation.apart = 70;
    for (std::uint32_t k = 1; k < plans_.size(); ++k)
      invitation.members.push_back({EntityId{k}, 1});
    for (std::uint32_t k = 0; k < plans_.size(); ++k)
      members_.emplace_back(EntityId{k}, NegotiationName{EntityId{0}, 1}, invitation,
                            NegotiatingFlight{plans_[k], 120, {}}, 0, Time());
    free_.assign(plans_.size(), true);
    present_.assign(plans_.size(), true);
  }

  void refuse(std::size_t who) { free_[who] = false; }
  void remove(std::size_t who) { present_[who] = false; }
  GroupNegotiation& member(std::size_t who) { return members_[who]; }

  // Until it is over for all.
  void run() {
    for (double now = 0; now < 20; now += 0.5) {
      std::vector<Message> out;
      for (std::size_t k = 0; k < members_.size(); ++k) {
        if (!present_[k]) continue;
        const GroupNegotiation::View view{
            [&](std::span<const JoinedMember> joined) { return solve(joined); },
            [&](const FlightPlan&) { return bool{free_[k]}; }};
        if (members_[k].state() != GroupNegotiation::State::kFailed)
          members_[k].step(Time::from_seconds(now), view, out);
        if (members_[k].state() == GroupNegotiation::State::kAgreed)
          for (GroupNegotiation& other : members_)
            if (&other != &members_[k] && arrives()) other.other_flies_it();
      }
      for (const Message& message : out) deliver(message);
    }
  }

  std::size_t agreed() const {
    return static_cast<std::size_t>(std::ranges::count(
        members_, GroupNegotiation::State::kAgreed, &GroupNegotiation::state));
  }

  // Of the flights as they are in the end.
  int encounters() const {
    int count = 0;
    for (std::size_t i = 0; i < plans_.size(); ++i)
      for (std::size_t j = i + 1; j < plans_.size(); ++j)
        if (first_encounter(flown(i), flown(j), {50, 20}, 15, 300)) ++count;
    return count;
  }

 private:
  const FlightPlan& flown(std::size_t k) const {
    const bool changes = members_[k].state() == GroupNegotiation::State::kAgreed &&
                         members_[k].flight().has_value();
    return changes ? *members_[k].flight() : plans_[k];
  }
  bool arrives() { return std::uniform_real_distribution<>(0, 1)(random_) >= loss_; }

  void deliver(const Message& message) {
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const EntityId who{static_cast<std::uint32_t>(k)};
      if (who == message.from || (message.to != kEveryone && message.to != who) ||
          !present_[k] || !arrives())
        continue;
      std::visit(
          [&](const auto& said) {
            if constexpr (requires { members_[k].take(message.from, said); })
              members_[k].take(message.from, said);
          },
          message.content);
    }
  }

  std::optional<std::vector<GroupManoeuvre>> solve(std::span<const JoinedMember> joined) {
    std::vector<FlightPlan> plans;
    for (const JoinedMember& each : joined) plans.push_back(plans_[each.who.value]);
    JointProblem problem = joint_problem(plans);
    problem.begin = 15;
    for (auto& member : problem.members)
      for (std::size_t k = 0; k < plans_.size(); ++k)
        if (std::ranges::find(joined, EntityId{static_cast<std::uint32_t>(k)},
                              &JoinedMember::who) == joined.end())
          member.others.push_back({&plans_[k], {50, 20}});
    const JointSolution solution = solve_jointly(problem, 30000);
    std::vector<GroupManoeuvre> all;
    for (std::size_t k = 0; k < joined.size(); ++k) {
      const JointChoice& choice = solution.choices[k];
      if (choice.manoeuvre.kind != ManoeuvreKind::kGoOn)
        all.push_back({joined[k].who, static_cast<std::uint8_t>(choice.manoeuvre.kind),
                       static_cast<float>(choice.manoeuvre.amount),
                       static_cast<float>(choice.manoeuvre.lead),
                       static_cast<float>(choice.conflict.meets),
                       static_cast<float>(choice.conflict.closest),
                       static_cast<float>(choice.conflict.apart), 50, 20});
    }
    return all;
  }

  std::vector<FlightPlan> plans_;
  double loss_;
  std::mt19937 random_;
  std::vector<GroupNegotiation> members_;
  std::vector<bool> free_, present_;
};

TEST(GroupNegotiation, AllFlyWhatComesOut) {
  SmallGroup group(6, 0, 1);
  group.run();
  EXPECT_EQ(group.agreed(), 6U);
  EXPECT_EQ(group.encounters(), 0);
}

TEST(GroupNegotiation, WhoDoesNotAnswerIsLeftOut) {
  SmallGroup group(6, 0, 1);
  group.remove(3);
  group.run();
  EXPECT_EQ(group.agreed(), 5U);
  // Of fifteen before; with the one that was left out there may be one yet to solve.
  EXPECT_LE(group.encounters(), 1);
}

TEST(GroupNegotiation, NobodyFliesWhatOneCannot) {
  SmallGroup group(6, 0, 1);
  // Some have to change; of all but the coordinator none may.
  for (std::size_t k = 1; k < 6; ++k) group.refuse(k);
  group.run();
  EXPECT_EQ(group.agreed(), 0U);
}

// With messages lost all agree or none does, as long as those who fly it are heard.
TEST(GroupNegotiation, LostMessagesPartNobody) {
  int agreed = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SmallGroup group(5, 0.3, seed);
    group.run();
    if (group.agreed() == 0) continue;
    ++agreed;
    EXPECT_EQ(group.encounters(), 0) << seed;
  }
  EXPECT_GE(agreed, 30);
}

TEST(GroupNegotiation, WhatMakesNoSenseChangesNothing) {
  SmallGroup group(3, 0, 1);
  GroupNegotiation& member = group.member(1);
  GroupPlan forged{1, {EntityId{1}}, {}};
  member.take(EntityId{2}, forged);  // not of the coordinator
  member.take(EntityId{2}, GroupAcceptance{EntityId{0}, 1, false});
  EXPECT_EQ(member.state(), GroupNegotiation::State::kOpen);
  GroupNegotiation& coordinator = group.member(0);
  GroupJoining impossible;
  impossible.group = 1;
  impossible.limits.airspeed = std::nanf("");
  coordinator.take(EntityId{1}, impossible);
  coordinator.take(EntityId{99}, GroupJoining{1, 120, said_limits({})});
  group.run();
  EXPECT_EQ(group.agreed(), 3U);
}

}  // namespace
}  // namespace skein::reasoning::group_negotiation_test
