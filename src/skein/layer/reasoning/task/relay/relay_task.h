// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/agent/task_executor.h"

namespace skein::reasoning {

/// Stays half way between two others, by what they last reported of their places, so that
/// each hears it as well as the other does. Before both have reported it stays where it
/// is.
class RelayTask final : public TaskExecutor {
 public:
  explicit RelayTask(const Relay& order) : order_(order) {}

  const FlightIntent* plan(const TaskStep& step, AgentOutput& out) override;
  TaskProgress progress(const AgentInput&) const override { return {}; }
  TaskKind rest() const override { return order_; }

 private:
  Relay order_;
  FlightIntent intent_;
  bool placed_ = false;
};

}  // namespace skein::reasoning
