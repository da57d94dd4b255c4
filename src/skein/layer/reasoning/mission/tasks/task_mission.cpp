// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/mission/tasks/task_mission.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::reasoning {
TaskMission::TaskMission(const std::vector<EntityId>& team, std::vector<ListedTask> tasks)
    : TaskingMission(team) {
  for (ListedTask& task : tasks) entries_.push_back({std::move(task), {}, false});
}

MissionDemand TaskMission::demand() const {
  MissionDemand demand;
  demand.max = 0;
  for (const Entry& entry : entries_)
    if (!entry.over) ++demand.max;
  demand.min = std::min(1, demand.max);
  for (const Entry& entry : entries_)
    if (!entry.over && !entry.flown_by && !demand.place)
      demand.place = needs_of(entry.task.what).begin;
  return demand;
}

bool TaskMission::done() const {
  return std::all_of(entries_.begin(), entries_.end(),
                     [](const Entry& entry) { return entry.over; });
}

void TaskMission::pursue(const AgentInput& in, AgentOutput& out) {
  for (Entry& entry : entries_) look_at(entry, in.now, out);
  for (Entry& entry : entries_) {
    if (entry.over || entry.flown_by) continue;
    Aircraft* who = free_for(entry);
    if (!who) continue;
    entry.flown_by = who->id;
    order(*who, entry.task.what, in.now, out);
  }
}

void TaskMission::look_at(Entry& entry, Time now, AgentOutput& out) {
  if (!entry.flown_by || entry.over) return;
  const auto who = std::find_if(team().begin(), team().end(), [&](const Aircraft& a) {
    return a.id == *entry.flown_by;
  });
  if (!who->mine) {
    // Another goes on with what is left.
    if (!who->has_done()) entry.task.what = rest_of(*who);
    entry.over = who->has_done();
    entry.flown_by.reset();
    return;
  }
  if (who->confirmed != who->task.number) return;
  const bool impossible = who->state == TaskState::kImpossible;
  entry.over = impossible || who->state == TaskState::kDone;
  if (!entry.over) return;
  out.events.push_back({now, who->id,
                        impossible ? EventKind::kTaskGivenUp : EventKind::kTaskOver,
                        fmt::format("{}", kind_of(entry.task.what))});
}

TaskingMission::Aircraft* TaskMission::free_for(const Entry& entry) {
  const auto place = needs_of(entry.task.what).begin;
  Aircraft* best = nullptr;
  for (Aircraft& each : team()) {
    const bool busy = std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) {
      return !e.over && e.flown_by == each.id;
    });
    if (!each.mine || busy || (entry.task.aircraft && *entry.task.aircraft != each.id))
      continue;
    const auto distance = [&](const Aircraft& a) {
      return place ? (geo::horizontal(a.nav.p_N) - *place).norm() : 0;
    };
    if (!best || distance(each) < distance(*best)) best = &each;
  }
  return best;
}

}  // namespace skein::reasoning
