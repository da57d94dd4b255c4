// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "skein/layer/reasoning/agent/task_executor.h"

namespace skein::reasoning {

/// Circles a point, or where the aircraft is when the task begins, until another comes.
class StayTask final : public TaskExecutor {
 public:
  explicit StayTask(const Loiter& order) : centre_(order.centre) {}
  explicit StayTask(const Hold&) {}

  const FlightIntent* plan(const TaskStep& step, AgentOutput&) override {
    if (!centre_) centre_ = geo::horizontal(step.in.nav->p_N);
    intent_.what = Circling{*centre_, {}};
    return &intent_;
  }
  TaskProgress progress(const AgentInput&) const override { return {}; }
  TaskKind rest() const override {
    return centre_ ? TaskKind(Loiter{*centre_}) : TaskKind(Hold{});
  }

 private:
  std::optional<Vec2> centre_;
  FlightIntent intent_;
};

}  // namespace skein::reasoning
