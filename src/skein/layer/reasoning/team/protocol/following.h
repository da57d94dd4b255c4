// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// What a follower does: it obeys the orders of its leader and of nobody else, says what
/// the leader does not know yet, and notices when it is lost, hands over, or follows
/// somebody else.
class TeamFollowing {
 public:
  void begin(MemberState& member, EntityId leader, TeamReason reason);
  /// It leads now: what it executes is its own order.
  void end(EntityId self);
  /// Its leader is lost.
  void lose_leader(MemberState& member);
  static bool is_leader_lost(const MemberState& member) {
    return member.now - member.leader.evidence > member.lost;
  }

  /// What it executes ends when a new leader gives no order in time.
  void drop_old_order(MemberState& member);
  /// What goes out with each `inform`: news to the leader, and what the team knows to
  /// stations that do not receive the leader.
  static void send_news(MemberState& member);

  TeamTransition on(MemberState& member, EntityId from, const TeamQuery& query);
  TeamTransition on(MemberState& member, EntityId from, const TeamInform& inform);
  static TeamTransition on(const MemberState& member, EntityId from,
                           const TeamHere& here);
  static void on(MemberState& member, EntityId from, const TeamState& state);
  /// @returns  whether it leaves out some of the order, as these tasks are done or left
  ///           to others: that has to be said.
  bool on(MemberState& member, EntityId from, const TeamAssign& assign);

  /// A member counts its orders anew.
  void forget_orders_of(EntityId id) { orders_from_.erase(id); }

 private:
  std::optional<EntityId> announced_;              // who leads next
  std::map<EntityId, std::uint32_t> orders_from_;  // the number of each one's last
  std::optional<EntityId> order_of_;               // whose order it executes
  std::optional<double> order_until_;  // when the first one of a new leader is due [s]
};

}  // namespace skein::reasoning
