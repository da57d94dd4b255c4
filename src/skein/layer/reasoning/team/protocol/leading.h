// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "skein/layer/reasoning/team/protocol/allocator.h"
#include "skein/layer/reasoning/team/protocol/branches.h"
#include "skein/layer/reasoning/team/protocol/encounters.h"
#include "skein/layer/reasoning/team/protocol/followers.h"

namespace skein::reasoning {

/// What a leader does, by parts that do not know each other: it asks its followers, takes
/// newcomers in, allocates and orders tasks, meets other leaders, and hands over when it
/// shall not lead any more.
class TeamLeading {
 public:
  explicit TeamLeading(EntityId self) : followers_(self) {}

  void begin(MemberState& member, const LeadTeam& how);
  void end(MemberState& member, ProposalDisplay& display);
  void step(MemberState& member, ProposalDisplay& display);
  /// One query period is over.
  void send_query(MemberState& member);

  /// Of a leader of the same mission or of another branch.
  TeamTransition on(MemberState& member, EntityId from, const TeamQuery& query);
  void on(MemberState& member, EntityId from, const TeamInform& inform);
  void on(MemberState& member, EntityId from, const TeamPropose& propose);
  void on(MemberState& member, EntityId from, const TeamConfirm& confirm);
  void on(MemberState& member, EntityId from, const TeamDecline& decline);
  void on(MemberState& member, EntityId from, const TeamAssignAck& ack);
  void on(MemberState& member, EntityId from, const TeamState& state);
  void on(MemberState& member, EntityId from, const TeamMerge& merge);
  void on(MemberState& member, EntityId from, const TeamSplit& split);
  /// @param from  may be itself, when an operator is with it.
  void on(MemberState& member, EntityId from, const TeamDecision& decision,
          ProposalDisplay& display);

  bool has_followers() const { return !followers_.empty(); }
  bool orders_acknowledged() const { return followers_.orders_acknowledged(); }

 private:
  void hand_over(MemberState& member);
  void take_in_team(MemberState& member, EntityId from, const TeamMerge& merge);
  bool may_add_tasks(const MemberState& member, EntityId from,
                     const TeamState& state) const;
  void order_what_is_in_force(MemberState& member);

  TeamFollowers followers_;
  TeamBranches branches_;
  TeamEncounters encounters_;
  TeamAllocator allocator_;
  double led_since_ = 0;  // [s]
  std::optional<EntityId> predecessor_, successor_;
  double successor_since_ = 0;                  // [s]
  std::map<EntityId, std::uint32_t> accepted_;  // newcomers, and in which exchange
  std::uint32_t queries_ = 0;                   // during which nobody lagged behind
};

}  // namespace skein::reasoning
