// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/reasoning/agent/task_executor.h"
#include "skein/layer/reasoning/task/follow/slot_plan.h"
#include "skein/model/path/plan_curve.h"

namespace skein::reasoning {

/// Keeps a place beside another aircraft, by the positions that this one reports. Until
/// the first of them it stays where it is; without them for a while it goes on as the
/// leader was last heard to fly, then it flies its last plan to its end and circles
/// there.
class FollowTask final : public TaskExecutor {
 public:
  /// @param horizon  the path to the place is planned for this long [s].
  FollowTask(const FlightContext& context, const FollowLeader& order, double horizon)
      : limits_(context.limits), order_(order), horizon_(horizon) {}

  void listen(const TaskStep& step) override;
  const FlightIntent* plan(const TaskStep& step, AgentOutput& out) override;
  TaskProgress progress(const AgentInput&) const override { return {}; }
  TaskKind rest() const override { return order_; }
  void interrupt() override { demanded_.reset(); }

 private:
  void hear(const TeamPosition& reported);
  const FlightIntent* wait(const NavEstimate& nav);

  FlightLimits limits_;
  FollowLeader order_;
  double horizon_;
  FlightIntent intent_;
  bool waits_ = false;
  std::optional<LeaderMotion> leader_;
  // The last plan to the place. The next one goes on at its height: one that began at the
  // aircraft's own would never call back what gusts have carried off.
  std::optional<model::PlanCurve> demanded_;
};

}  // namespace skein::reasoning
