#include "skein/layer/reasoning/team/protocol/knowledge.h"

#include <algorithm>

#include "skein/layer/reasoning/team/protocol/fingerprint.h"

namespace skein::reasoning {
namespace {

constexpr std::size_t kTasksInPart = 8;

std::pair<EntityId, EntityId> pair_of(EntityId a, EntityId b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

void TeamKnowledge::submit(std::span<const TeamTask> all) {
  for (const TeamTask& task : all) tasks[task.number] = task;
}

std::uint32_t TeamKnowledge::meetings(EntityId a, EntityId b) const {
  const auto found = met_.find(pair_of(a, b));
  return found == met_.end() ? 0 : found->second;
}

void TeamKnowledge::note(const TeamMeeting& meeting) {
  std::uint32_t& times = met_[pair_of(meeting.lower, meeting.higher)];
  times = std::max(times, meeting.times);
}

std::uint32_t TeamKnowledge::number() const {
  std::vector<TeamTask> all;
  for (const auto& [number, task] : tasks) all.push_back(task);
  return short_fingerprint(all);
}

std::uint32_t TeamKnowledge::parts() const {
  const std::size_t parts = (tasks.size() + kTasksInPart - 1) / kTasksInPart;
  return static_cast<std::uint32_t>(std::max<std::size_t>(1, parts));
}

TeamState TeamKnowledge::part(std::uint32_t index, std::vector<EntityId> members) const {
  TeamState state;
  state.number = number();
  state.parts = parts();
  state.part = index % state.parts;
  state.members = std::move(members);
  for (const auto& [pair, times] : met_)
    state.met.push_back({pair.first, pair.second, times});
  std::size_t at = 0;
  for (const auto& [number, task] : tasks)
    if (at++ / kTasksInPart == state.part) state.tasks.push_back(task);
  return state;
}

void TeamKnowledge::take(const TeamState& state) {
  for (const TeamMeeting& meeting : state.met) note(meeting);
  if (incoming_.number != state.number) incoming_ = {state.number, {}};
  incoming_.parts[state.part] = state.tasks;
  if (incoming_.parts.size() < state.parts) return;
  tasks.clear();
  for (const auto& [part, some] : incoming_.parts) submit(some);
}

bool TeamKnowledge::add(const TeamState& state) {
  const std::uint32_t before = number();
  for (const TeamMeeting& meeting : state.met) note(meeting);
  for (const TeamTask& task : state.tasks) {
    const auto [place, is_new] = tasks.try_emplace(task.number, task);
    if (!is_new && task.done) place->second.done = true;
    if (!is_new && task.released) place->second.released = true;
  }
  return number() != before;
}

std::uint32_t hash_of_members(const std::vector<EntityId>& members) {
  return short_fingerprint(members);
}

}  // namespace skein::reasoning
