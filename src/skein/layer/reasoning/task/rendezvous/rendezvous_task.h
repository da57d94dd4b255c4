// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/task/planned_task.h"

namespace skein::reasoning {

/// Is at a point at a time: by its airspeed as far as that goes, then by detours
/// (solve::arrive_at); as soon as it can, with an event "late", when that is later.
/// Then it stays there.
class RendezvousTask final : public PlannedTask {
 public:
  RendezvousTask(const FlightContext& context, const Rendezvous& order);

  TaskKind rest() const override { return order_; }

 private:
  Part plan_part(const Start& start, const TaskStep& step) override;
  bool finish(const TaskStep& step, AgentOutput& out) override;
  const FlightIntent* before(const TaskStep& step, AgentOutput& out) override;
  std::optional<Vec2> end_place() const override { return order_.point; }

  Rendezvous order_;
  double late_by_ = 0, said_late_ = 0;  // [s]
};

}  // namespace skein::reasoning
