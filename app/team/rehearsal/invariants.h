// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "app/team/rehearsal/network.h"

namespace skein::rehearsal {

/// What must hold all the time, whatever happens to a team (see docs/team.md):
///
/// - two members that hear each other do not execute the same single task for longer than
///   T_lost + 3 T_q and two round trips;
/// - no task is without an executor for longer than T_lost + 5 s and two round trips
///   while an idle able member that follows or leads hears of it.
class TeamInvariants {
 public:
  explicit TeamInvariants(double round_trip) : round_trip_(round_trip) {}

  /// Looks at all members; to be called each step.
  void look(const std::map<EntityId, reasoning::TeamMember>& members,
            const TeamNetwork& network, double now);
  /// Who hears whom has changed: times begin anew.
  void contacts_changed() { doubles_.clear(); }

  double longest_double() const { return longest_double_; }          ///< [s]
  double longest_unattended() const { return longest_unattended_; }  ///< [s]
  int violations() const { return violations_; }
  const std::string& first_violation() const { return first_; }

 private:
  void look_at_doubles(const std::map<EntityId, reasoning::TeamMember>& members,
                       const TeamNetwork& network, double now);
  void look_at_unattended(const std::map<EntityId, reasoning::TeamMember>& members,
                          const TeamNetwork& network, double now);
  void violated(std::string what);

  double round_trip_;
  using Pair = std::tuple<std::uint32_t, EntityId, EntityId>;
  struct Since {
    double begin = 0;
    bool counted = false;
  };
  std::map<Pair, Since> doubles_;
  std::map<std::pair<std::uint32_t, EntityId>, Since> unattended_;
  double longest_double_ = 0, longest_unattended_ = 0;
  int violations_ = 0;
  std::string first_;
};

}  // namespace skein::rehearsal
