// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "skein/data/team/task_form.h"
#include "skein/layer/reasoning/agent/task_executor.h"
#include "skein/layer/reasoning/task/edge/edge_follower.h"
#include "skein/layer/reasoning/task/tour/tour_task.h"
#include "skein/scenario/kind_table.h"

namespace skein::assemble {

/// How an aircraft flies each kind of task, and with what.
struct TaskOptions {
  reasoning::EdgeFollowerOptions edge;
  /// Between course and edge, whatever the order says [rad]; none: the order's.
  std::optional<double> edge_angle;
  double follow_horizon = 8;  ///< paths to the place beside a leader last this long [s]
  bool lands = false;         ///< after the last lap of a route
  bool stays = true;          ///< where it was to fly to; else it leaves the run there
  reasoning::TourOptions tour;
  bool has_camera = false;
};

/// What every executor of a task is given besides the task's values.
struct TaskContext {
  const reasoning::FlightContext& flight;  ///< who flies it, and how
  const TaskOptions& options;
};

/// The kinds of tasks, one row each: how tasks of the kind are written, what is wrong
/// with one, where it takes place and what it takes, all by the description of its values
/// (data/team/task_value.h), and what flies it.
class TaskKinds {
 public:
  using Made = Result<std::unique_ptr<reasoning::TaskExecutor>>;

  /// Adds the row of the tasks with values T, a described struct. `maker(values,
  /// context)` returns a unique_ptr of a TaskExecutor or a Result of one; the values have
  /// been checked. Its body is in task_row.h, for source files that add rows.
  template <class T, class Make>
  TaskKinds& add(Make maker);

  /// The executor of a task.
  /// Fails: kBadInput with the reason when the task says nothing to fly, there is no row
  ///        of its kind, or this aircraft is not able to.
  Made make(const TaskKind& task, const TaskContext& context) const;

  /// How tasks are written, in the order of the rows.
  const std::shared_ptr<const TaskForms>& forms() const { return forms_; }

  /// Adds all rows of `more`, which has none of these names.
  void append(const TaskKinds& more);

  /// Adds names and helps to the table that scenarios are read with.
  /// Fails: Bug when a name is taken.
  void describe(scenario::KindTable& table) const;

 private:
  using MakeRow = std::function<Made(const TaskKind&, const TaskContext&)>;
  void add_row(TaskForm form, MakeRow make);

  std::shared_ptr<const TaskForms> forms_ = std::make_shared<const TaskForms>();
  std::vector<MakeRow> makers_;  // beside the forms
};

/// Skein's own.
TaskKinds task_kinds();

}  // namespace skein::assemble
