// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/go_to/go_to_task.h"

#include <fmt/format.h>

#include <algorithm>

#include "skein/model/connection/point_connection.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kSamePlace = 1;    // nearer is the same place [m]
constexpr double kReached = 2;      // a point is, this near to it [turn radii]
constexpr double kMinReached = 50;  // and this near at least [m]

PlannedTaskOptions first_is_best(bool over_ground, bool stays) {
  PlannedTaskOptions own;
  own.in_time = false;  // the first to arrive is the best
  own.over_ground = over_ground;
  own.stays = stays;
  return own;
}

// The same flight, climbed or sunk evenly, or as far as the aircraft can.
void climb_evenly(FlightPlan& plan, double up, const FlightLimits& limits) {
  const double duration = model::duration(plan);
  if (!(duration > 0)) return;
  const double rate = std::clamp(up / duration, -limits.sink_rate, limits.climb_rate);
  const double start = model::start_of(plan);
  for (FlightElement& e : plan) {
    e.p_N.z() -= rate * (e.start - start);
    e.climb_rate = rate;
  }
}

}  // namespace

GoToTask::GoToTask(const FlightContext& context, const Vec2& point,
                   std::optional<double> altitude_msl, bool stays)
    : PlannedTask(context, first_is_best(!altitude_msl, stays)),
      point_(point),
      altitude_msl_(altitude_msl),
      place_(point) {}

// Where it climbs evenly its plans begin where it is.
double GoToTask::altitude_of_plans(const NavEstimate& nav) const {
  return altitude_msl_ ? -nav.p_N.z() : PlannedTask::altitude_of_plans(nav);
}

// The point, or the nearest place that no zone forbids.
const FlightIntent* GoToTask::before(const TaskStep& step, AgentOutput& out) {
  ZoneMonitor& zones = step.safety.zones();
  if (zones.zones().empty() && place_ == point_) return nullptr;
  const NavEstimate& nav = *step.in.nav;
  const Vec2 allowed = zones.allowed(point_, nav, altitude_of_plans(nav));
  if ((allowed - place_).norm() <= kSamePlace) return nullptr;
  place_ = allowed;
  renew();
  out.events.push_back(
      {step.in.now, context().self, EventKind::kTaskMoved,
       allowed == point_
           ? std::string("no zone forbids the place of the task any more")
           : fmt::format("the place of the task lies in a no-fly zone: {:.0f} m north, "
                         "{:.0f} m east instead",
                         allowed.x(), allowed.y())});
  return nullptr;
}

PlannedTask::Part GoToTask::plan_part(const Start& start, const TaskStep&) {
  const model::Pose from{geo::horizontal(start.state.p_N), start.state.heading};
  const model::AirMotion air{start.limits.airspeed, start.limits.turn_radius, start.wind};
  const model::PointConnection path = model::connect_to_point(from, place_, air);
  Part part;
  if (path.status == model::ConnectionStatus::kFound)
    part.plan = model::to_flight_plan(path, from, air, start.time, start.state.p_N.z());
  if (path.status != model::ConnectionStatus::kFound)
    part.why_not = fmt::format(
        "the wind of {:.1f} m/s is too strong to fly to a point at "
        "{:.1f} m/s",
        start.wind.norm(), air.airspeed);
  if (altitude_msl_)
    climb_evenly(part.plan, *altitude_msl_ + start.state.p_N.z(), start.limits);
  if (!length_ && !part.plan.empty()) length_ = model::duration(part.plan);
  return part;
}

bool GoToTask::finish(const TaskStep& step, AgentOutput&) {
  const double near = std::max(kMinReached, kReached * context().limits.turn_radius);
  return (geo::horizontal(step.in.nav->p_N) - place_).norm() < near;
}

TaskProgress GoToTask::progress(const AgentInput& in) const {
  TaskProgress progress = PlannedTask::progress(in);
  if (!progress.done && progress.time_to_go && length_.value_or(0) > 0)
    progress.share = std::clamp(1 - *progress.time_to_go / *length_, 0.0, 1.0);
  return progress;
}

}  // namespace skein::reasoning
