#pragma once

#include <optional>

#include "skein/data/path.h"
#include "skein/layer/reasoning/task/guided_task.h"

namespace skein::reasoning {

/// Flies to a point and circles it.
///
/// When the point lies in a no-fly zone, the nearest place where the aircraft can circle
/// takes its place, named in an event "task-moved".
class PointTask final : public GuidedTask {
 public:
  enum class Goal {
    kReach,   ///< done when it has passed the point
    kCircle,  ///< never done
  };
  PointTask(TaskContext context, const Vec2& point, Goal goal)
      : GuidedTask(std::move(context)), point_(point), goal_(goal) {}

  bool done() const override { return done_; }

 private:
  Setpoint next_setpoint(const TaskStep& step, double altitude_msl,
                         AgentOutput& out) override;
  Setpoint fly_to(const Vec2& point, const TaskStep& step);
  bool must_plan(const TaskStep& step);
  Vec2 allowed(const TaskStep& step, double altitude_msl, AgentOutput& out);

  Vec2 point_;
  Goal goal_;
  bool done_ = false;
  std::optional<Vec2> moved_;  // where the point has been moved to
  Path path_;
  Vec2 path_wind_ = Vec2::Zero();  // that it was planned for
  double along_ = 0;
};

}  // namespace skein::reasoning
