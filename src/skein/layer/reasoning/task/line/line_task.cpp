// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/line/line_task.h"

#include <algorithm>

#include "skein/layer/reasoning/trajectory/steering_flight.h"
#include "skein/model/path/path_geometry.h"

namespace skein::reasoning {
namespace {

constexpr double kPursuit = 3;  // its point is ahead by this flight time [s]
constexpr double kJoin = 2;     // it begins this near to its start [turn radii]
constexpr double kEnd = 20;     // and ends this far before its end [m]

Path straight_path(const std::vector<Vec2>& points) {
  Path path;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2 d = points[i + 1] - points[i];
    if (d.norm() > 0) path.push_back({points[i], geo::bearing(d), d.norm(), 0});
  }
  return path;
}

Steering on_course(double course) {
  Steering steering;
  steering.guidance = HoldCourse{course};
  steering.course = course;
  return steering;
}

}  // namespace

LineTask::LineTask(FlightContext context, const FollowLine& order)
    : SteeringTask(std::move(context)),
      order_(order),
      path_(straight_path(order.points)) {
  for (const PathElement& element : path_) length_ += element.length;
}

Steering LineTask::steer(const TaskStep& step, AgentOutput&) {
  const NavEstimate& nav = *step.in.nav;
  if (order_.points.empty()) {
    done_ = true;
    return circle_at(step.safety.home(), nav, context().limits);
  }
  const Vec2& last = order_.points.back();
  const Vec2 position = geo::horizontal(nav.p_N);
  const double near = kJoin * context().limits.turn_radius;
  if (path_.empty() || done_) {
    done_ = done_ || (last - position).norm() < near;
    return circle_at(last, nav, context().limits);
  }
  const Vec2 to_start = order_.points.front() - position;
  joined_ = joined_ || to_start.norm() < near;
  return joined_ ? along_line(nav) : on_course(geo::bearing(to_start));
}

Steering LineTask::along_line(const NavEstimate& nav) {
  const Vec2 position = geo::horizontal(nav.p_N);
  const double ahead =
      std::max(kPursuit * geo::horizontal(nav.v_N).norm(), context().limits.turn_radius);
  const auto at = model::project(path_, position, along_, along_ + 3 * ahead);
  along_ = at.along;
  double corner = 0;
  std::uint32_t passed = 1;
  for (const PathElement& element : path_) {
    corner += element.length;
    if (corner > along_) break;
    ++passed;
  }
  passed_ = passed;
  if (at.remaining < kEnd) {
    done_ = true;
    return circle_at(order_.points.back(), nav, context().limits);
  }
  return on_course(
      geo::bearing(model::pose_at(path_, along_ + ahead).position - position));
}

TaskProgress LineTask::progress(const AgentInput& in) const {
  TaskProgress progress;
  progress.done = done_;
  progress.share = done_ ? 1 : length_ > 0 ? along_ / length_ : 0;
  const double speed = in.nav ? geo::horizontal(in.nav->v_N).norm() : 0;
  if (done_)
    progress.time_to_go = 0;
  else if (joined_ && speed > 1)
    progress.time_to_go = (length_ - along_) / speed;
  return progress;
}

// From where it is on the line.
TaskKind LineTask::rest() const {
  if (passed_ == 0 || path_.empty()) return order_;
  FollowLine left;
  left.points.push_back(model::pose_at(path_, std::min(along_, length_)).position);
  for (std::size_t k = passed_; k < order_.points.size(); ++k)
    left.points.push_back(order_.points[k]);
  return left;
}

}  // namespace skein::reasoning
