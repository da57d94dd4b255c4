#include "skein/layer/reasoning/task/line_task.h"

#include <algorithm>

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

}  // namespace

LineTask::LineTask(TaskContext context, const FollowLine& order)
    : GuidedTask(std::move(context)), order_(order), path_(straight_path(order.points)) {}

GuidedTask::Setpoint LineTask::next_setpoint(const TaskStep& step, double, AgentOutput&) {
  const NavEstimate& nav = *step.in.nav;
  const Vec2 position = geo::horizontal(nav.p_N);
  if (order_.points.empty()) {
    done_ = true;
    return circle_at(step.safety.home(), nav);
  }
  const Vec2& last = order_.points.back();
  const double near = kJoin * context().limits.turn_radius;
  if (path_.empty() || done_) {
    done_ = done_ || (last - position).norm() < near;
    return circle_at(last, nav);
  }
  const Vec2 to_start = order_.points.front() - position;
  joined_ = joined_ || to_start.norm() < near;
  if (!joined_) return {HoldCourse{geo::bearing(to_start)}, geo::bearing(to_start)};

  const double ahead =
      std::max(kPursuit * geo::horizontal(nav.v_N).norm(), context().limits.turn_radius);
  const auto at = model::project(path_, position, along_, along_ + 3 * ahead);
  along_ = at.along;
  if (at.remaining < kEnd) {
    done_ = true;
    return circle_at(last, nav);
  }
  const double course =
      geo::bearing(model::pose_at(path_, along_ + ahead).position - position);
  return {HoldCourse{course}, course};
}

}  // namespace skein::reasoning
