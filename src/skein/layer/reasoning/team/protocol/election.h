// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// Election of a leader among members that have none, by TeamConfig::select.
///
/// Nobody is asked: all choose by the same rule among those that they receive and that
/// may lead. Who is chosen by itself leads after a while; who chooses another one waits
/// for its query or order, and passes it over when that does not come. So nobody is known
/// as leader here before it has said that it leads.
class TeamElection {
 public:
  /// A new election, in which anybody may be chosen.
  void reset();

  /// Who leads from the beginning, without an election: the fixed leader, or a station
  /// when nobody else can know the mission yet.
  static TeamTransition first(const MemberState& member);

  /// One step of a member that has no leader.
  /// @param may_lead_alone  whether it may lead when it receives nobody, though it is
  ///                        about to leave.
  TeamTransition step(const MemberState& member, bool may_lead_alone);

  /// Whom it waits for, or itself.
  std::optional<EntityId> chosen() const { return chosen_; }

 private:
  std::optional<EntityId> chosen_;
  double chosen_since_ = 0;         // [s]
  std::set<EntityId> passed_over_;  // were chosen, and did not lead
};

}  // namespace skein::reasoning
