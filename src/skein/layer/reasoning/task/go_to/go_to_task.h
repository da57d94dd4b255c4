// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/reasoning/task/planned_task.h"

namespace skein::reasoning {

/// Flies to a point by the quickest path in the wind, then circles it.
///
/// While the point lies in a no-fly zone, the nearest place where the aircraft can circle
/// takes its place, named in an event "task-moved".
class GoToTask : public PlannedTask {
 public:
  /// @param stays  see Itinerary.
  GoToTask(const FlightContext& context, const FlyTo& order, bool stays = true)
      : GoToTask(context, order.point, order.altitude_msl, stays) {}

  TaskProgress progress(const AgentInput& in) const override;
  TaskKind rest() const override { return FlyTo{point_, altitude_msl_}; }
  std::optional<double> altitude_msl() const override { return altitude_msl_; }

 protected:
  /// @param altitude_msl  see FlyTo.
  GoToTask(const FlightContext& context, const Vec2& point,
           std::optional<double> altitude_msl = std::nullopt, bool stays = true);

  Part plan_part(const Start& start, const TaskStep& step) override;
  const FlightIntent* before(const TaskStep& step, AgentOutput& out) override;
  bool finish(const TaskStep& step, AgentOutput& out) override;
  std::optional<Vec2> end_place() const override { return point_; }
  double altitude_of_plans(const NavEstimate& nav) const override;

  const Vec2& point() const { return point_; }
  const Vec2& place() const { return place_; }

 private:
  Vec2 point_;
  std::optional<double> altitude_msl_;
  Vec2 place_;                    // that is flown to
  std::optional<double> length_;  // of the first path [s]
};

}  // namespace skein::reasoning
