// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/reasoning/agent/task_executor.h"

namespace skein::reasoning {

/// Flies home by the route planned for returns and stays above.
class ReturnTask final : public TaskExecutor {
 public:
  explicit ReturnTask(const FlightContext& context) : context_(context) {}

  const FlightIntent* plan(const TaskStep& step, AgentOutput& out) override;
  TaskProgress progress(const AgentInput&) const override;
  TaskKind rest() const override { return ReturnHome{}; }
  void interrupt() override { intent_.number = 0; }

 private:
  FlightContext context_;
  FlightIntent intent_;
  bool done_ = false;
};

/// Lands at home or at a place, and stays there.
class LandTask final : public TaskExecutor {
 public:
  LandTask(const FlightContext& context, const LandAt& order)
      : context_(context), order_(order) {}

  const FlightIntent* plan(const TaskStep& step, AgentOutput& out) override;
  TaskProgress progress(const AgentInput&) const override;
  TaskKind rest() const override { return order_; }
  void interrupt() override { intent_.number = 0; }
  bool may_stand() const override { return true; }

 private:
  FlightContext context_;
  LandAt order_;
  FlightIntent intent_;
  bool done_ = false;
};

}  // namespace skein::reasoning
