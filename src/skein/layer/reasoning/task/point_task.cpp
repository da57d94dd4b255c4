#include "skein/layer/reasoning/task/point_task.h"

#include <fmt/format.h>

#include <cmath>

#include "skein/model/path/path_geometry.h"
#include "skein/model/path/point_path.h"

namespace skein::reasoning {
namespace {

constexpr double kSamePlace = 1;     // nearer is the same place [m]
constexpr double kReplanWind = 2;    // change of the wind that makes a new path [m/s]
constexpr double kReplanCross = 60;  // distance off a path that makes a new one [m]
constexpr double kCourseAhead = 3;   // of the path, whose bearing is the course [s]
constexpr double kSearched = 10;     // of the path for where it is [s]

}  // namespace

GuidedTask::Setpoint PointTask::next_setpoint(const TaskStep& step, double altitude_msl,
                                              AgentOutput& out) {
  const Vec2 place = allowed(step, altitude_msl, out);
  return goal_ == Goal::kReach ? fly_to(place, step) : circle_at(place, *step.in.nav);
}

// The point, or the nearest place that no zone forbids.
Vec2 PointTask::allowed(const TaskStep& step, double altitude_msl, AgentOutput& out) {
  const Vec2 instead = step.safety.zones().allowed(point_, *step.in.nav, altitude_msl);
  const Vec2 before = moved_.value_or(point_);
  if ((instead - before).norm() <= kSamePlace) return before;
  moved_ = instead;
  path_.clear();
  out.events.push_back(
      {step.in.now, context().self, "task-moved",
       instead == point_
           ? std::string("no zone forbids the place of the task any more")
           : fmt::format("the place of the task lies in a no-fly zone: {:.0f} m north, "
                         "{:.0f} m east instead",
                         instead.x(), instead.y())});
  return instead;
}

bool PointTask::must_plan(const TaskStep& step) {
  const NavEstimate& nav = *step.in.nav;
  if (path_.empty() || step.safety.zones().deflecting() ||
      (nav.wind_N - path_wind_).norm() > kReplanWind)
    return true;
  const double window = kSearched * geo::horizontal(nav.v_N).norm();
  const auto at =
      model::project(path_, geo::horizontal(nav.p_N), along_ - window, along_ + window);
  along_ = at.along;
  return std::abs(at.cross_track) > kReplanCross;
}

GuidedTask::Setpoint PointTask::fly_to(const Vec2& point, const TaskStep& step) {
  const NavEstimate& nav = *step.in.nav;
  const Vec2 position = geo::horizontal(nav.p_N);
  const Vec2 velocity = geo::horizontal(nav.v_N);
  if (!path_.empty() && !step.safety.zones().deflecting() && step.in.autopilot.done)
    done_ = true;
  if (done_) return circle_at(point, nav);
  if (must_plan(step)) {
    path_ = model::path_to_point({position, geo::bearing(velocity)}, point,
                                 wide_radius(nav.wind_N));
    path_wind_ = nav.wind_N;
    along_ = 0;
    if (path_.empty()) {
      done_ = true;
      return circle_at(point, nav);
    }
  }
  const Vec2 ahead =
      model::pose_at(path_, along_ + kCourseAhead * velocity.norm()).position - position;
  return {FollowPath{path_}, geo::bearing(ahead)};
}

}  // namespace skein::reasoning
