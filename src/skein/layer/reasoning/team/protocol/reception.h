// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// Decides which messages a member acts upon; what is broken, forged or old changes
/// nothing, and is reported once in a while.
class TeamReception {
 public:
  /// Remembers the sender, and what it says of itself.
  /// @returns  whether to act upon it.
  bool accept(MemberState& member, const TeamReceived& received);

 private:
  void refuse(MemberState& member, const TeamReceived& received, TeamVerdict verdict);

  std::map<std::pair<EntityId, TeamVerdict>, double> refused_;  // when last reported [s]
};

}  // namespace skein::reasoning
