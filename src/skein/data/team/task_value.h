// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "skein/data/describe/plugin_value.h"
#include "skein/data/describe/type_traits.h"
#include "skein/data/describe/walk.h"
#include "skein/data/team/task.h"
#include "skein/data/team/task_facts.h"

/// Values of a kind of task, and the form in which all tasks travel.
namespace skein {

namespace detail {

template <class T, class Variant>
inline constexpr bool kIsAlternative = false;
template <class T, class... Ts>
inline constexpr bool kIsAlternative<T, std::variant<Ts...>> = (std::is_same_v<T, Ts> ||
                                                                ...);

// Calls `visit(id)` for each entity that the values are about.
template <class T, class Visit>
void for_each_id(T& values, Visit visit) {
  for_each_field<std::remove_const_t<T>>(
      [&]<class O, class M, class F>(const Field<O, M, F>& f) {
        if constexpr (type_traits::kIsId<M>) visit(values.*f.member);
      });
}

}  // namespace detail

/// Whether messages have a type for a kind of task. Those of others are NamedTasks.
template <class T>
inline constexpr bool kHasMessageType = detail::kIsAlternative<T, TaskKind>;

/// What is wrong with the values of a task, for people; empty when they say something to
/// fly: what its check_task() says, and numbers that are none.
template <Described T>
std::string value_error(const T& values) {
  T looked_at = values;
  if (!walk::has_sound_numbers(looked_at)) return "one of its numbers is none.";
  if constexpr (requires { check_task(values); })
    return check_task(values);
  else
    return {};
}

/// What a task takes: what its needs_of_task() says; else it takes place at its first
/// place, and in its course where it is about others.
template <Described T>
TaskNeeds value_needs(const T& values) {
  if constexpr (requires { needs_of_task(values); }) {
    return needs_of_task(values);
  } else {
    TaskNeeds needs;
    bool alone = true;
    for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>& f) {
      if constexpr (std::is_same_v<M, Vec2>) {
        if (!needs.begin) needs = needs_at(values.*f.member);
      } else if constexpr (std::is_same_v<M, std::vector<Vec2>>) {
        if (!needs.begin && !(values.*f.member).empty())
          needs = needs_at((values.*f.member).front());
      } else if constexpr (type_traits::kIsId<M>) {
        alone = false;
      }
    });
    needs.foreseen = needs.foreseen && alone;
    return needs;
  }
}

/// A task of these values, as it travels.
template <Described T>
TaskKind as_task(T values) {
  if constexpr (kHasMessageType<T>) {
    return TaskKind(std::move(values));
  } else {
    NamedTask task;
    task.kind = kind_of<T>();
    detail::for_each_id(values, [&](EntityId id) { task.others.push_back(id); });
    task.needs = value_needs(values);
    task.coded = to_coded(values);
    return task;
  }
}

/// The values of a task.
/// @returns  none: it is of another kind, or its bytes are no T.
template <Described T>
std::optional<T> task_as(const TaskKind& task) {
  if constexpr (kHasMessageType<T>) {
    const T* values = std::get_if<T>(&task);
    return values ? std::optional(*values) : std::nullopt;
  } else {
    const auto* named = std::get_if<NamedTask>(&task);
    if (!named || named->kind != kind_of<T>()) return std::nullopt;
    auto decoded = from_coded<T>(named->coded);
    if (!decoded) return std::nullopt;
    std::optional<T> values = std::move(decoded).value();
    // Who binds names to numbers need not know the kind.
    std::size_t next = 0;
    detail::for_each_id(*values, [&](EntityId& id) {
      if (next < named->others.size()) id = named->others[next++];
    });
    return values;
  }
}

}  // namespace skein
