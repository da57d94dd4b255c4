#pragma once

#include "skein/data/path.h"
#include "skein/layer/reasoning/task/guided_task.h"

namespace skein::reasoning {

/// Follows a line of points once, from its first point, then circles its last. Without
/// points it circles where the flight began.
class LineTask final : public GuidedTask {
 public:
  LineTask(TaskContext context, const FollowLine& order);

  bool done() const override { return done_; }

 private:
  Setpoint next_setpoint(const TaskStep& step, double altitude_msl,
                         AgentOutput& out) override;

  FollowLine order_;
  Path path_;
  double along_ = 0;
  bool joined_ = false;  // its first point has been reached
  bool done_ = false;
};

}  // namespace skein::reasoning
