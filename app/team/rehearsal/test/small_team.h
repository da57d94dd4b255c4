// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/team/rehearsal/network.h"

namespace skein::rehearsal {

/// Some members on one medium, stepped ten times a second.
struct SmallTeam {
  TeamNetwork network{{}, 1, 0};
  std::map<EntityId, reasoning::TeamMember> members;
  std::map<EntityId, double> clock_offset;  ///< [s]
  std::vector<Event> events;
  double now = 0;

  reasoning::TeamMember& add(std::uint32_t id, reasoning::TeamConfig config = {}) {
    network.join({id});
    return members.try_emplace({id}, EntityId{id}, std::move(config)).first->second;
  }
  void crash(std::uint32_t id) {
    network.leave({id});
    members.erase({id});
  }
  reasoning::TeamMember& at(std::uint32_t id) { return members.at({id}); }

  static std::vector<TeamTask> tasks(std::uint32_t count) {
    std::vector<TeamTask> all(count);
    for (std::uint32_t k = 0; k < count; ++k) all[k].number = k + 1;
    return all;
  }
  void submit(std::uint32_t count) {
    for (auto& [id, member] : members)
      member.submit("M", tasks(count), Time::from_seconds(now + clock_offset[id]));
  }

  void run(double duration) {
    const double end = now + duration;
    while (now < end - 1e-9) {
      now += 0.1;
      std::vector<std::pair<EntityId, std::vector<reasoning::TeamOutgoing>>> sent;
      for (auto& [id, member] : members) {
        const auto received = network.receive(id, now);
        auto step = member.step(Time::from_seconds(now + clock_offset[id]), received);
        events.insert(events.end(), step.events.begin(), step.events.end());
        sent.emplace_back(id, std::move(step.send));
      }
      for (const auto& [id, messages] : sent) network.send(id, messages, now);
    }
  }

  int count(EventKind kind) const {
    int n = 0;
    for (const Event& event : events) n += event.kind == kind ? 1 : 0;
    return n;
  }
  /// Whom each follows; 0: nobody.
  std::map<std::uint32_t, std::uint32_t> masters() const {
    std::map<std::uint32_t, std::uint32_t> all;
    for (const auto& [id, member] : members)
      all[id.value] = member.status().master.value_or(EntityId{0}).value;
    return all;
  }
  /// How many execute each task.
  std::map<std::uint32_t, int> executors() const {
    std::map<std::uint32_t, int> all;
    for (const auto& [id, member] : members)
      for (const std::uint32_t task : member.tasks()) ++all[task];
    return all;
  }
};

}  // namespace skein::rehearsal
