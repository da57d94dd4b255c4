// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

class TeamBranches;

/// What leaders of one mission do when they meet: one gives way to the other, and when
/// they meet again they split the mission, and both stay.
///
/// The higher id of the two gives way, or asks for a split: only it decides, so that both
/// agree on how often they met. Who has led for less than it takes to be heard of is no
/// leader of another team, but has begun to lead in one that has a leader: it gives way,
/// and that does not count as an encounter.
class TeamEncounters {
 public:
  /// Its lead begins or ends.
  void clear();
  /// Another leader of the mission is received.
  /// @param led_since  when this one began to lead [s].
  TeamTransition meet(MemberState& member, EntityId other, const TeamQuery& query,
                      double led_since, TeamBranches& branches);
  /// Asks again for a split that is not answered, and gives up in the end.
  void step(MemberState& member);
  bool waits_for_split() const { return asked_.has_value(); }
  /// Whether another leader is about to give way: both stop assigning until it has or
  /// does not seem to receive.
  bool is_held(const MemberState& member);
  /// Another one does not lead any more, or not here.
  void forget(EntityId other) { rivals_.erase(other); }
  bool has_split_with(EntityId other) const { return split_with_.contains(other); }

  /// The other one asks for a split.
  /// @param tasks  that are open.
  /// @param own    who can be given tasks here.
  void answer_split(MemberState& member, EntityId other, const TeamMerge& merge,
                    std::span<const TeamTask> tasks, std::span<const TeamWorker> own,
                    TeamBranches& branches);
  /// The other one has split the mission.
  void on(MemberState& member, EntityId from, const TeamSplit& split,
          TeamBranches& branches);

 private:
  // Another leader that should give way.
  struct Rival {
    double first = 0, last = 0;  // when it was received [s]
  };
  // A split that was asked for.
  struct Asked {
    EntityId of;
    double first = 0, last = 0;  // when [s]
    std::map<std::uint32_t, std::vector<TeamTask>> parts;
  };
  TeamTransition yield_to(MemberState& member, EntityId other, bool counted);
  void ask_split(MemberState& member, EntityId other);

  std::map<EntityId, Rival> rivals_;
  std::optional<Asked> asked_;
  std::set<EntityId> split_with_;
};

/// All that a leader knows of the mission, to all.
void send_knowledge(MemberState& member);

}  // namespace skein::reasoning
