// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "skein/data/describe/describe.h"
#include "skein/data/team/task_kinds.h"

namespace skein {

/// What an aircraft may be asked to do: the place in this list is part of the wire form.
/// A kind of task needs no place here; without one it travels as a NamedTask.
using TaskKind = std::variant<Loiter, FlyTo, FollowEdge, FollowLine, FlyCourse, FlyRoute,
                              FollowLeader, FlyTour, Hold, Survey, Patrol, Orbit, Measure,
                              Rendezvous, Relay, FlyPlan, ReturnHome, LandAt, NamedTask>;

/// The word for a task. Valid as long as the task.
std::string_view kind_of(const TaskKind& task);

/// Whom a task is about: whose positions who flies it needs.
std::vector<EntityId> others_of(const TaskKind& task);

/// Puts numbers of entities into a task, in the order in which it is about them; as many
/// as it is about, else nothing is done.
void bind_others(TaskKind& task, std::span<const EntityId> others);

/// What is wrong with the values of a task, for people; empty when it says something to
/// fly. Of a NamedTask what can be said without its kind.
std::string task_error(const TaskKind& task);

/// Where a task takes place, and what it takes. Lengths are of straight legs; of a survey
/// the area over the distance of its lines.
TaskNeeds needs_of(const TaskKind& task);

/// One order for one aircraft. Numbers grow; an agent keeps the newest.
struct Task {
  std::uint32_t number = 0;
  TaskKind what = Loiter{};
};

constexpr auto describe(const Task*) {
  using T = Task;
  return described<T>({"task"}, "One order for one aircraft.",
                      field("task_number", &T::number, "the newest counts"),
                      field("what", &T::what, Storage::kJson, "what to do"));
}

/// What an order about the present task asks for.
enum class TaskAction : std::uint8_t { kPause, kResume, kCancel };
constexpr auto names_of(const TaskAction*) {
  return std::to_array<std::string_view>({"pause", "resume", "cancel"});
}

/// An order about the task that an aircraft has. Its number is one of the same row as
/// those of tasks.
struct TaskChange {
  std::uint32_t number = 0;
  TaskAction action = TaskAction::kPause;
};

constexpr auto describe(const TaskChange*) {
  using T = TaskChange;
  return described<T>({"task_change"}, "An order about the task that an aircraft has.",
                      field("task_number", &T::number, "the newest counts"),
                      field("action", &T::action, "pause, resume or cancel"));
}

/// How high and how fast an aircraft is to fly its tasks from now on. Its numbers are a
/// row of their own. An aircraft says it back, with all that it flies by then.
struct FlightChange {
  std::uint32_t number = 0;
  std::optional<double> altitude_agl = std::nullopt;  ///< [m]; none: as before
  std::optional<double> airspeed = std::nullopt;      ///< [m/s]; none: as before
};

constexpr auto describe(const FlightChange*) {
  using T = FlightChange;
  return described<T>({"flight_change"}, "How high and how fast an aircraft flies.",
                      field("number", &T::number, "the newest counts"),
                      field("altitude_agl", &T::altitude_agl, unit::kMetre,
                            "above the ground; null: as before"),
                      field("airspeed", &T::airspeed, unit::kMetrePerSecond,
                            "at cruise; null: as before"));
}

/// How far an aircraft is with its task.
enum class TaskState : std::uint8_t {
  kNone,  ///< it has none
  kFlying,
  kPaused,
  kDone,
  kImpossible,  ///< it cannot be flown, or not any more
};
constexpr auto names_of(const TaskState*) {
  return std::to_array<std::string_view>(
      {"none", "flying", "paused", "done", "impossible"});
}

/// What an aircraft has still to do of a task: said when that changes, so that another
/// can go on with it.
struct TaskReport {
  std::uint32_t number = 0;  ///< of the task
  TaskState state = TaskState::kNone;
  std::string reason;  ///< why it is impossible; else empty
  TaskKind rest = Loiter{};
};

constexpr auto describe(const TaskReport*) {
  using T = TaskReport;
  return described<T>({"task_report"}, "What an aircraft has still to do of its task.",
                      field("task_number", &T::number, "of the task"),
                      field("state", &T::state, "how far it is"),
                      field("reason", &T::reason, "why it is impossible; else empty"),
                      field("rest", &T::rest, Storage::kJson, "what is left of it"));
}

}  // namespace skein
