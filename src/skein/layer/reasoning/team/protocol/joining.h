// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// How a newcomer finds a team: it listens for leaders, offers itself to all that it
/// receives, and joins the one whose tasks are nearest of those that accept it.
class TeamJoining {
 public:
  TeamTransition step(MemberState& member);
  void on(MemberState& member, EntityId from, const TeamAccept& accept);
  void on(MemberState& member, EntityId from, const TeamReject& reject);

 private:
  std::vector<EntityId> leaders(MemberState& member) const;
  TeamTransition choose(MemberState& member);

  std::uint32_t exchange_ = 0;  // counts its tries
  double first_leader_ = -1;    // when one was first received [s]; < 0: none
  double proposed_ = -1;        // when it proposed [s]; < 0: it listens
  double next_ = 0;             // when proposals are repeated [s]
  double rest_until_ = 0;       // [s]
  std::map<EntityId, std::optional<TeamAccept>> asked_;  // none: no answer yet
  std::set<EntityId> rejected_;
};

}  // namespace skein::reasoning
