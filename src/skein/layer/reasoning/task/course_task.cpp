#include "skein/layer/reasoning/task/course_task.h"

namespace skein::reasoning {

GuidedTask::Setpoint CourseTask::next_setpoint(const TaskStep&, double, AgentOutput&) {
  return {HoldCourse{course_}, course_};
}

}  // namespace skein::reasoning
