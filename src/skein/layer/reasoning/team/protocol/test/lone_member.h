// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// What the parts of one member have in common, and others that send to it: to try a part
/// alone.
struct LoneMember {
  MemberState state;
  std::map<EntityId, std::uint32_t> sent;  ///< by the others, to all

  explicit LoneMember(EntityId self, TeamConfig config = {}) : state(self, config) {
    state.mission = TeamMission{"M"};
    state.role = TeamRole::kSelecting;
    state.members = {self};
    at(0);
  }
  /// A step begins [s].
  void at(double now) { state.begin(Time::from_seconds(now)); }

  /// Another one sends to all.
  void receive(EntityId from, TeamContent content) {
    state.contacts.take(from, true,
                        {TeamMessage::kVersion, ++sent[from], std::move(content)},
                        state.now, {});
  }
  /// Another one says whom it follows; none: nobody.
  TeamInform receive_inform(EntityId from, std::optional<EntityId> leader = std::nullopt,
                            bool leaving = false) {
    TeamInform inform;
    inform.mission = state.mission;
    inform.master = leader;
    inform.leaving = leaving;
    inform.state_number = state.knowledge.number();
    receive(from, inform);
    return inform;
  }
  /// Another one leads the same mission, or a branch of it.
  TeamQuery receive_query(EntityId from, double led = 100,
                          std::optional<EntityId> branch = std::nullopt) {
    TeamQuery query;
    query.mission = TeamMission{"M", branch};
    query.led = static_cast<float>(led);
    receive(from, query);
    return query;
  }

  /// What has been sent since the step began; the step ends.
  template <class Content>
  std::vector<Content> take_sent() {
    std::vector<Content> all;
    for (const TeamOutgoing& out : state.outbox.take().send)
      if (const auto* content = std::get_if<Content>(&out.message.content))
        all.push_back(*content);
    return all;
  }
};

/// Tasks 1 to `count`, 100 m apart.
inline std::vector<TeamTask> tasks_in_a_row(std::uint32_t count) {
  std::vector<TeamTask> all(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    all[k].number = k + 1;
    all[k].place = Vec2(100.0 * k, 0);
  }
  return all;
}

inline bool is_none(const TeamTransition& transition) {
  return std::holds_alternative<std::monostate>(transition);
}

}  // namespace skein::reasoning
