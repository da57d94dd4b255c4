// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/task/planned_task.h"

namespace skein::reasoning {

/// Flies a plan as it is, altitudes included: by the quickest path to its start, there
/// when the plan says, or as soon after as can be; where any time will do, as soon as it
/// can.
class PlanTask final : public PlannedTask {
 public:
  PlanTask(const FlightContext& context, const FlyPlan& order);

  TaskProgress progress(const AgentInput& in) const override;
  TaskKind rest() const override;
  std::uint32_t version() const override { return static_cast<std::uint32_t>(next_); }
  std::optional<double> altitude_msl() const override;

 private:
  Part plan_part(const Start& start, const TaskStep& step) override;
  void pass(const TaskStep&) override;
  double altitude_of_plans(const NavEstimate& nav) const override;

  FlyPlan order_;
  std::size_t next_ = 0;  // element that is flown, or is to be flown
  bool on_it_ = false;
};

}  // namespace skein::reasoning
