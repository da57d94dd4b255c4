// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/task/steering_task.h"

namespace skein::reasoning {

/// Flies a course over ground until another task comes.
class CourseTask final : public SteeringTask {
 public:
  CourseTask(FlightContext context, const FlyCourse& order)
      : SteeringTask(std::move(context)), order_(order) {}

  TaskProgress progress(const AgentInput&) const override { return {}; }
  TaskKind rest() const override { return order_; }

 private:
  Steering steer(const TaskStep&, AgentOutput&) override {
    Steering steering;
    steering.guidance = HoldCourse{order_.course};
    steering.course = order_.course;
    return steering;
  }

  FlyCourse order_;
};

}  // namespace skein::reasoning
