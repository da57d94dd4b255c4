// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/edge/edge_task.h"

namespace skein::reasoning {

void EdgeTask::listen(const TaskStep& step) {
  const NavEstimate& nav = *step.in.nav;
  const Vec2 velocity = geo::horizontal(nav.v_N);
  for (const FireReading& reading : step.readings)
    follower_.add(reading, geo::bearing(velocity));
  for (const SensorSample& sample : step.in.samples)
    if (const auto* edge = std::get_if<EdgeSample>(&sample)) {
      const double ago = (nav.time - edge->time).seconds();
      follower_.add(*edge, geo::horizontal(nav.p_N) - ago * velocity);
    }
}

Steering EdgeTask::steer(const TaskStep& step, AgentOutput& out) {
  const double course = follower_.course(step.in.now, geo::horizontal(step.in.nav->p_N));
  if (follower_.lost() != lost_) {
    lost_ = !lost_;
    out.events.push_back(
        {step.in.now, context().self,
         lost_ ? EventKind::kEdgeLost : EventKind::kEdgeFound,
         lost_ ? "has lost the fire's edge" : "has found the fire's edge again"});
  }
  Steering steering;
  steering.guidance = HoldCourse{course};
  steering.course = course;
  return steering;
}

}  // namespace skein::reasoning
