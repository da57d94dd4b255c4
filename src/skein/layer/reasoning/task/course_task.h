#pragma once

#include "skein/layer/reasoning/task/guided_task.h"

namespace skein::reasoning {

/// Flies a course over ground until another task comes.
class CourseTask final : public GuidedTask {
 public:
  /// @param course  [rad].
  CourseTask(TaskContext context, double course)
      : GuidedTask(std::move(context)), course_(course) {}

 private:
  Setpoint next_setpoint(const TaskStep&, double, AgentOutput&) override;

  double course_;
};

}  // namespace skein::reasoning
