// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// What a member does for the operator who is with it: it keeps the tasks that the
/// operator hands in until the team has them, and follows whoever leads the team.
class TeamStation {
 public:
  void hand_in(std::span<const TeamTask> tasks);
  /// The operator does not want a task any more.
  /// @returns  false when it is not known here, or over.
  bool withdraw(MemberState& member, std::uint32_t task);
  /// Withdraws what was withdrawn while it was on its way, once it has arrived.
  void step(MemberState& member);
  /// To the leader: what that does not know.
  void send_handed_in(MemberState& member) const;
  /// It leads itself: the team has these tasks.
  void add_handed_in(MemberState& member) const;

  /// All that are known here, those among them that the leader has not received yet.
  std::map<std::uint32_t, TeamTask> all_tasks(const TeamKnowledge& knowledge) const;

  /// Whether it has received none of its team for long: then it leads again, as others
  /// lead on where it does not receive them.
  static bool is_team_gone(const MemberState& member);
  /// A station needs no orders: what others say of their leader is enough to follow it,
  /// and to lead no more.
  /// @param has_followers  of its own.
  static TeamTransition on(MemberState& member, EntityId from, const TeamInform& inform,
                           bool has_followers);

 private:
  std::map<std::uint32_t, TeamTask> handed_in_;
  std::set<std::uint32_t> withdrawn_;  // of those, before the team was known to have them
};

}  // namespace skein::reasoning
