// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "skein/layer/reasoning/agent/task_executor.h"
#include "skein/layer/reasoning/task/edge/edge_follower.h"
#include "skein/layer/reasoning/task/tour/tour_task.h"

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

/// The executor of a task.
/// Fails: kBadInput with the reason when the task says nothing to fly, or this aircraft
///        is not able to.
Result<std::unique_ptr<reasoning::TaskExecutor>> make_task(
    const TaskKind& task, const reasoning::FlightContext& context,
    const TaskOptions& options);

}  // namespace skein::assemble
