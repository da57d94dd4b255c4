// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "skein/layer/reasoning/agent/task_executor.h"

namespace skein::reasoning {

/// A task that says at each step what to fly just now.
class SteeringTask : public TaskExecutor {
 public:
  explicit SteeringTask(FlightContext context) : context_(std::move(context)) {}

  const FlightIntent* plan(const TaskStep& step, AgentOutput& out) final {
    intent_.what = steer(step, out);
    return &intent_;
  }

 protected:
  virtual Steering steer(const TaskStep& step, AgentOutput& out) = 0;

  const FlightContext& context() const { return context_; }

 private:
  FlightContext context_;
  FlightIntent intent_;
};

}  // namespace skein::reasoning
