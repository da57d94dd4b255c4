// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/task/edge/edge_follower.h"
#include "skein/layer/reasoning/task/steering_task.h"

namespace skein::reasoning {

/// Follows the edge of a fire with the in/out sensor or an edge sensor.
class EdgeTask final : public SteeringTask {
 public:
  EdgeTask(FlightContext context, const EdgeFollowerOptions& options,
           const FollowEdge& order)
      : SteeringTask(std::move(context)), order_(order), follower_(options, order) {}

  void listen(const TaskStep& step) override;
  TaskProgress progress(const AgentInput&) const override { return {}; }
  TaskKind rest() const override { return order_; }

 private:
  Steering steer(const TaskStep& step, AgentOutput& out) override;

  FollowEdge order_;
  EdgeFollower follower_;
  bool lost_ = false;
};

}  // namespace skein::reasoning
