// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/path.h"
#include "skein/layer/reasoning/task/steering_task.h"

namespace skein::reasoning {

/// Follows a line of points once, from its first point, then circles its last. Without
/// points it circles where the flight began.
class LineTask final : public SteeringTask {
 public:
  LineTask(FlightContext context, const FollowLine& order);

  TaskProgress progress(const AgentInput& in) const override;
  TaskKind rest() const override;
  std::uint32_t version() const override { return passed_; }

 private:
  Steering steer(const TaskStep& step, AgentOutput& out) override;
  Steering along_line(const NavEstimate& nav);

  FollowLine order_;
  Path path_;
  double along_ = 0;
  double length_ = 0;
  std::uint32_t passed_ = 0;  // points
  bool joined_ = false;       // its first point has been reached
  bool done_ = false;
};

}  // namespace skein::reasoning
