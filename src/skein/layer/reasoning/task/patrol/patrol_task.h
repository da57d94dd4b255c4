// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/task/planned_task.h"

namespace skein::reasoning {

/// Flies along a line again and again, offset from it, corners rounded as far as the
/// line stays near (solve::plan_patrol); a few rounds are planned at a time, with the
/// wind as it then is.
class PatrolTask final : public PlannedTask {
 public:
  PatrolTask(const FlightContext& context, const Patrol& order)
      : PlannedTask(context, {}), order_(order) {}

  TaskProgress progress(const AgentInput& in) const override;
  TaskKind rest() const override;
  std::uint32_t version() const override { return static_cast<std::uint32_t>(rounds_); }

 private:
  Part plan_part(const Start& start, const TaskStep& step) override;
  void pass(const TaskStep&) override;

  Patrol order_;
  int rounds_ = 0;                // flown
  int planned_ = 0;               // flown and planned
  std::vector<bool> ends_round_;  // of the milestones that are planned, from the next on
};

}  // namespace skein::reasoning
