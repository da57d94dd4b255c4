// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/duplicates.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace skein::reasoning {
namespace {

// Whether it says that it executes a task, and is not done with it.
bool executes(const TeamInform& inform, std::uint32_t task) {
  return std::ranges::any_of(inform.tasks, [task](const TeamProgress& progress) {
    return progress.task == task && progress.share < 1;
  });
}

}  // namespace

void DuplicateTasks::on(MemberState& member, EntityId from, const TeamInform& inform) {
  std::erase_if(known_, [&](const auto& each) {
    return each.second == from &&
           !(executes(inform, each.first) && member.own.executes(each.first));
  });
  const auto& own = member.status.master;
  if (!member.is_of_lineage(inform.mission) || !inform.master || !own) return;
  const auto* leader = member.contacts.find(*own);
  const double silent = kSilentPeriods * member.times().query_period;
  const bool superseded = member.follows() && inform.master == own && from != *own &&
                          leader && member.now - member.leader.received > silent &&
                          inform.query > leader->query_number;
  const bool yields = member.leads() ? inform.master != own : inform.master < own;
  std::vector<std::uint32_t> left;
  for (const std::uint32_t task : member.own.executing()) {
    const auto known = member.knowledge.tasks.find(task);
    const bool single = known != member.knowledge.tasks.end() && known->second.single;
    if (!single || !executes(inform, task)) {
      left.push_back(task);
      continue;
    }
    if (known_.insert({task, from}).second)
      member.outbox.report(EventKind::kTeamTaskTwice,
                           fmt::format("{} executes task {} too.", from.value, task),
                           {.other = from, .team_task = task});
    if (yields) member.own.yield(task, from);
    if (!superseded && !yields) left.push_back(task);
  }
  if (left.size() == member.own.executing().size()) return;
  member.outbox.report(
      superseded ? EventKind::kTeamOrderSuperseded : EventKind::kTeamTaskYielded,
      fmt::format("what {} executes too is dropped.", from.value), {.other = from});
  member.execute(std::move(left));
}

void DuplicateTasks::renew_refusals(MemberState& member) {
  member.own.renew_refusals([&member](std::uint32_t task, EntityId id) {
    const auto* other = member.contacts.find(id);
    return other && member.now - other->informed <= member.follower_lost_after() &&
           other->inform.master != member.status.master && executes(other->inform, task);
  });
}

}  // namespace skein::reasoning
