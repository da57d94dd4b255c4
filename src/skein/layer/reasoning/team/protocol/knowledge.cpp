// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/knowledge.h"

#include <algorithm>

#include "skein/layer/reasoning/team/protocol/fingerprint.h"

namespace skein::reasoning {
namespace {

constexpr std::size_t kTasksInPart = 8;

std::pair<EntityId, EntityId> pair_of(EntityId a, EntityId b) {
  return {std::min(a, b), std::max(a, b)};
}

bool knows_more(const TeamTask& own, const TeamTask& other) {
  return (own.done && !other.done) || (own.withdrawn && !other.withdrawn) ||
         (own.released && !other.released) || (own.branch && !other.branch);
}

// What both know of a task together: nothing of it is ever undone.
void learn(TeamTask& own, const TeamTask& other) {
  own.done = own.done || other.done;
  own.withdrawn = own.withdrawn || other.withdrawn;
  own.released = own.released || other.released;
  if (!own.branch) own.branch = other.branch;
}

}  // namespace

void TeamKnowledge::submit(std::span<const TeamTask> all) {
  for (const TeamTask& task : all) tasks[task.number] = task;
}

bool TeamKnowledge::withdraw(std::uint32_t task) {
  const auto known = tasks.find(task);
  if (known == tasks.end() || known->second.done) return false;
  known->second.done = known->second.withdrawn = true;
  news_.insert(task);
  return true;
}

bool TeamKnowledge::finish(std::uint32_t task) {
  const auto known = tasks.find(task);
  if (known == tasks.end() || known->second.done) return false;
  known->second.done = true;
  return true;
}

bool TeamKnowledge::is_over(std::uint32_t task) const {
  const auto known = tasks.find(task);
  return known != tasks.end() && known->second.done;
}

std::vector<TeamTask> TeamKnowledge::open() const {
  std::vector<TeamTask> all;
  for (const auto& [number, task] : tasks) {
    if (task.done) continue;
    all.push_back(task);
    std::erase_if(all.back().after,
                  [this](std::uint32_t other) { return is_over(other); });
  }
  return all;
}

std::uint32_t TeamKnowledge::encounters(EntityId a, EntityId b) const {
  const auto found = met_.find(pair_of(a, b));
  return found == met_.end() ? 0 : found->second;
}

void TeamKnowledge::note(const TeamEncounter& encounter) {
  std::uint32_t& times = met_[pair_of(encounter.lower, encounter.higher)];
  times = std::max(times, encounter.times);
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
  for (const TeamEncounter& encounter : state.met) note(encounter);
  if (incoming_.number != state.number) incoming_ = {state.number, {}};
  incoming_.parts[state.part] = state.tasks;
  if (incoming_.parts.size() < state.parts) return;
  std::map<std::uint32_t, TeamTask> leaders;
  for (const auto& [part, some] : incoming_.parts)
    for (const TeamTask& task : some) leaders[task.number] = task;
  news_.clear();
  for (auto& [number, own] : tasks) {
    const auto [place, is_lacking] = leaders.try_emplace(number, own);
    if (is_lacking || knows_more(own, place->second)) news_.insert(number);
    learn(place->second, own);
  }
  tasks = std::move(leaders);
}

void TeamKnowledge::compare(std::span<const TeamTask> leaders) {
  for (const TeamTask& task : leaders)
    if (const auto own = tasks.find(task.number);
        own != tasks.end() && knows_more(own->second, task))
      news_.insert(task.number);
}

TeamState TeamKnowledge::news() const {
  TeamState state = part(0, {});
  state.tasks.clear();
  for (const std::uint32_t number : news_)
    if (state.tasks.size() < kTasksInPart) state.tasks.push_back(tasks.at(number));
  return state;
}

void TeamKnowledge::forget_leader() {
  incoming_ = {};
  news_.clear();
}

bool TeamKnowledge::add(const TeamState& state, std::optional<EntityId> branch) {
  const std::uint32_t before = number();
  for (const TeamEncounter& encounter : state.met) note(encounter);
  for (const TeamTask& task : state.tasks) {
    const auto [place, is_new] = tasks.try_emplace(task.number, task);
    if (!is_new) learn(place->second, task);
    if (is_new && !task.branch) place->second.branch = branch;
  }
  return number() != before;
}

bool TeamKnowledge::add_of_branch(const TeamState& state, EntityId theirs, EntityId own) {
  const std::uint32_t before = number();
  for (TeamTask said : state.tasks) {
    said.branch = said.branch.value_or(theirs);
    const auto [place, is_new] = tasks.try_emplace(said.number, said);
    if (is_new) continue;
    TeamTask& known = place->second;
    const EntityId claimed = known.branch.value_or(own);
    learn(known, said);
    if (said.branch == theirs)
      known.branch = claimed == own ? std::min(own, theirs) : theirs;
  }
  return number() != before;
}

void TeamKnowledge::divide(std::span<const TeamTask> divided) {
  for (const TeamTask& task : divided) {
    TeamTask& own = tasks.try_emplace(task.number, task).first->second;
    learn(own, task);
    if (task.branch) own.branch = task.branch;
  }
}

std::uint32_t hash_of_members(const std::vector<EntityId>& members) {
  return short_fingerprint(members);
}

}  // namespace skein::reasoning
