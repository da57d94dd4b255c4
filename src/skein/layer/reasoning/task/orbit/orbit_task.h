// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/reasoning/task/planned_task.h"

namespace skein::reasoning {

/// Stays with a point or an object on a circle or in S-turns (solve::plan_orbit), by
/// where the object is believed to be and how it moves; planned anew when it is found to
/// be elsewhere than was planned for, or when a part of the orbit comes to its end. While
/// a no-fly zone leaves no room for it, it circles as near as it can. Gimbals look at it.
class OrbitTask final : public PlannedTask {
 public:
  OrbitTask(const FlightContext& context, const Orbit& order);

  TaskProgress progress(const AgentInput& in) const override;
  TaskKind rest() const override;

 private:
  Part plan_part(const Start& start, const TaskStep& step) override;
  void pass(const TaskStep& step) override;
  const FlightIntent* before(const TaskStep& step, AgentOutput& out) override;
  Vec2 target_at(const TaskStep& step, Time time) const;
  Vec2 target_velocity(const TaskStep& step) const;

  Orbit order_;
  double radius_;
  FlightIntent beside_;          // while a zone leaves no room for the orbit
  std::optional<Time> arrived_;  // with the target
  Time now_;
  // As planned for.
  Time aimed_at_;
  Vec2 aim_ = Vec2::Zero(), aim_velocity_ = Vec2::Zero();
};

}  // namespace skein::reasoning
