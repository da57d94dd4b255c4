// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/team/task.h"

namespace skein {

/// A task as a person writes it, before names have become numbers and files plans.
struct TaskText {
  TaskKind what = Loiter{};
  std::vector<std::string> others;  ///< names, in the order of the task's entities
  std::string file;                 ///< that the plan of a FlyPlan is read from
};

/// How people, pages and other programs write the tasks of a kind. All of it follows from
/// the description of its values: task_form_of() (task_form_of.h).
struct TaskForm {
  using Words = std::span<const std::string_view>;

  std::string kind;   ///< the word for it
  std::string help;   ///< what the aircraft does
  std::string usage;  ///< "orbit NORTH,EAST [radius m]"
  TaskKind plain;     ///< with the values that it has when nothing is said

  /// A task from what follows its kind, whose numbers have been checked but for those of
  /// others.
  std::function<Result<TaskText>(Words)> parse;
  /// A task from the JSON of its values.
  std::function<Result<TaskKind>(const nlohmann::ordered_json&)> from_json;
  /// What is wrong with a task of this kind, for people; empty: nothing.
  std::function<std::string(const TaskKind&)> error;
  /// What a page needs to ask a person for such a task (docs/live-feed.md). Empty: pages
  /// do not.
  std::function<nlohmann::ordered_json()> page_form;
};

/// The kinds of tasks that can be written. Values once made; may be read by any thread.
class TaskForms {
 public:
  void add(TaskForm form) { all_.push_back(std::move(form)); }

  const std::vector<TaskForm>& all() const { return all_; }

  /// By its kind, or that without its first word: `fly_route`, `route`. Null: none.
  const TaskForm* find(std::string_view kind) const;

  /// What is wrong with a task, for people; empty: nothing. A kind that is not among
  /// these is.
  std::string error(const TaskKind& task) const;

 private:
  std::vector<TaskForm> all_;
};

/// Of the kinds that messages have types for.
const TaskForms& message_task_forms();

/// "fly_route" is also "route": what people say.
std::string_view short_kind(std::string_view kind);

}  // namespace skein
