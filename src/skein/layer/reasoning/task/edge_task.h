#pragma once

#include <optional>

#include "skein/layer/reasoning/agent/edge_follower.h"
#include "skein/layer/reasoning/task/guided_task.h"

namespace skein::reasoning {

/// Follows the edge of a fire with the in/out sensor or an edge sensor.
class EdgeTask final : public GuidedTask {
 public:
  EdgeTask(TaskContext context, const EdgeFollowerOptions& options,
           const FollowEdge& order)
      : GuidedTask(std::move(context)), follower_(options, order) {}

  void listen(const TaskStep& step) override;

 private:
  Setpoint next_setpoint(const TaskStep& step, double altitude_msl,
                         AgentOutput& out) override;

  EdgeFollower follower_;
  bool lost_ = false;
};

}  // namespace skein::reasoning
