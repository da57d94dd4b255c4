// SPDX-License-Identifier: Apache-2.0
#include "skein/data/team/task.h"

#include "skein/data/describe/type_traits.h"
#include "skein/data/describe/walk.h"
#include "skein/data/team/task_facts.h"

namespace skein {
namespace {

// Calls `visit(id)` for each entity that a task is about.
template <class Kind, class Visit>
void for_each_other(Kind& task, Visit visit) {
  std::visit(
      [&]<class T>(T& values) {
        using Plain = std::remove_const_t<T>;
        if constexpr (std::is_same_v<Plain, NamedTask>)
          for (auto& id : values.others) visit(id);
        else
          for_each_field<Plain>([&]<class O, class M, class F>(const Field<O, M, F>& f) {
            if constexpr (type_traits::kIsId<M>) visit(values.*f.member);
          });
      },
      task);
}

std::string check_task(const NamedTask& task) {
  if (task.kind.empty()) return "it has no kind.";
  TaskNeeds needs = task.needs;
  if (!walk::has_sound_numbers(needs) || !(needs.length >= 0) || !(needs.stay >= 0))
    return "what it takes is no number.";
  return needs.begin ? place_error(*needs.begin) : std::string();
}

TaskNeeds needs_of_task(const NamedTask& task) {
  return task.needs;
}

}  // namespace

std::string_view kind_of(const TaskKind& task) {
  if (const auto* named = std::get_if<NamedTask>(&task)) return named->kind;
  return std::visit([]<class T>(const T&) { return kind_of<T>(); }, task);
}

std::vector<EntityId> others_of(const TaskKind& task) {
  std::vector<EntityId> others;
  for_each_other(task, [&](EntityId id) { others.push_back(id); });
  return others;
}

void bind_others(TaskKind& task, std::span<const EntityId> others) {
  if (others.size() != others_of(task).size()) return;
  std::size_t next = 0;
  for_each_other(task, [&](EntityId& id) { id = others[next++]; });
}

std::string task_error(const TaskKind& task) {
  return std::visit([](const auto& values) { return check_task(values); }, task);
}

TaskNeeds needs_of(const TaskKind& task) {
  return std::visit([](const auto& values) { return needs_of_task(values); }, task);
}

}  // namespace skein
