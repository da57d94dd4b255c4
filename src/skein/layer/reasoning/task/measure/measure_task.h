// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/reasoning/task/go_to/go_to_task.h"

namespace skein::reasoning {

/// Flies to a point, stays there for a time, and says what it has sensed in an event
/// "measured": its wind and, with a fire sensor, the share of its readings inside.
class MeasureTask final : public GoToTask {
 public:
  MeasureTask(const FlightContext& context, const Measure& order)
      : GoToTask(context, order.point), order_(order) {}

  void listen(const TaskStep& step) override;
  TaskProgress progress(const AgentInput& in) const override;
  TaskKind rest() const override;

 private:
  const FlightIntent* before(const TaskStep& step, AgentOutput& out) override;
  bool finish(const TaskStep& step, AgentOutput& out) override;
  void report(const TaskStep& step, AgentOutput& out) const;

  Measure order_;
  std::optional<Time> arrived_;
  Time now_;
  FlightIntent circling_;
  int readings_ = 0, inside_ = 0, winds_ = 0;
  Vec2 wind_ = Vec2::Zero();  // sum
};

}  // namespace skein::reasoning
