// SPDX-License-Identifier: Apache-2.0
#include "app/team/rehearsal/invariants.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::rehearsal {
namespace {

bool executes(const reasoning::TeamMember& member, std::uint32_t task) {
  return std::ranges::find(member.tasks(), task) != member.tasks().end();
}

bool is_of_its_mission(const reasoning::TeamMember& member, const TeamTask& task) {
  const auto& mission = member.status().mission;
  return mission && (!mission->branch || !task.branch || mission->branch == task.branch);
}

}  // namespace

void TeamInvariants::violated(std::string what) {
  if (violations_++ == 0) first_ = std::move(what);
}

void TeamInvariants::look(const std::map<EntityId, reasoning::TeamMember>& members,
                          const TeamNetwork& network, double now) {
  look_at_doubles(members, network, now);
  look_at_unattended(members, network, now);
}

void TeamInvariants::look_at_doubles(
    const std::map<EntityId, reasoning::TeamMember>& members, const TeamNetwork& network,
    double now) {
  std::map<Pair, Since> still;
  for (auto a = members.begin(); a != members.end(); ++a)
    for (const std::uint32_t task : a->second.tasks())
      for (auto b = std::next(a); b != members.end(); ++b) {
        if (!executes(b->second, task) || !network.is_connected(a->first, b->first))
          continue;
        const Pair pair{task, a->first, b->first};
        const auto known = doubles_.find(pair);
        Since since = known == doubles_.end() ? Since{now, false} : known->second;
        const double length = now - since.begin;
        const double lost = std::max(a->second.lost_after(), b->second.lost_after());
        longest_double_ = std::max(longest_double_, length);
        if (!since.counted && length > lost + 3 + 2 * round_trip_) {
          since.counted = true;
          violated(
              fmt::format("t = {:.1f} s: {} and {} have executed task {} for {:.1f} s",
                          now, a->first.value, b->first.value, task, length));
        }
        still[pair] = since;
      }
  doubles_ = std::move(still);
}

void TeamInvariants::look_at_unattended(
    const std::map<EntityId, reasoning::TeamMember>& members, const TeamNetwork& network,
    double now) {
  std::map<std::pair<std::uint32_t, EntityId>, Since> still;
  for (const auto& [id, idle] : members) {
    if (!idle.tasks().empty() || !idle.status().master) continue;
    for (const auto& [number, task] : idle.knowledge().tasks) {
      if (task.done || !is_of_its_mission(idle, task)) continue;
      const bool attended = std::ranges::any_of(members, [&](const auto& other) {
        return network.is_connected(id, other.first) && executes(other.second, number);
      });
      if (attended) continue;
      const auto known = unattended_.find({number, id});
      Since since = known == unattended_.end() ? Since{now, false} : known->second;
      const double length = now - since.begin;
      longest_unattended_ = std::max(longest_unattended_, length);
      double lost = idle.lost_after();
      for (const auto& [other_id, other] : members)
        if (network.is_connected(id, other_id)) lost = std::max(lost, other.lost_after());
      if (!since.counted && length > lost + 5 + 2 * round_trip_) {
        since.counted = true;
        violated(
            fmt::format("t = {:.1f} s: nobody has executed task {} for {:.1f} s while "
                        "{} is idle",
                        now, number, length, id.value));
      }
      still[{number, id}] = since;
    }
  }
  unattended_ = std::move(still);
}

}  // namespace skein::rehearsal
