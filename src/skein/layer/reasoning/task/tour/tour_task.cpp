// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/tour/tour_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "skein/layer/reasoning/trajectory/altitude.h"

namespace skein::reasoning {
namespace {

PlannedTaskOptions flown_as(const TourOptions& tour) {
  PlannedTaskOptions options;
  options.radius_factor = tour.radius_factor;
  options.in_time = tour.keeps_times;
  options.over_ground = false;
  options.rejoins = false;
  options.stubborn = !tour.replans;
  return options;
}

}  // namespace

TourTask::TourTask(const FlightContext& context, const FlyTour& order,
                   const TourOptions& options)
    : PlannedTask(context, flown_as(options)),
      options_(options),
      order_(order),
      altitude_msl_(highest_along(*context.map, order.points) + context.altitude_agl),
      courses_(corner_courses(order.points)) {}

std::size_t TourTask::visits() const {
  return order_.points.size() * static_cast<std::size_t>(order_.laps);
}

const FlightIntent* TourTask::before(const TaskStep& step, AgentOutput&) {
  if (!begin_) {
    begin_ = step.in.now + Time::from_seconds(options_.settling);
    Steering wait;
    wait.guidance = HoldPosition{geo::horizontal(step.in.nav->p_N)};
    wait.altitude_msl = altitude_msl_;
    settling_.what = wait;
  }
  return step.in.now < *begin_ ? &settling_ : nullptr;
}

// What is left of the lap: from the aircraft the points that it has not passed, from the
// end of a plan those behind it.
PlannedTask::Part TourTask::plan_part(const Start& start, const TaskStep&) {
  // Led off its plan behind the last point, it flies to that one again.
  if (flown().empty()) planned_ = passed_ = std::min(passed_, visits() - 1);
  const std::size_t first = planned_ % order_.points.size();
  const model::AirMotion air{start.limits.airspeed, start.limits.turn_radius, start.wind};
  TourPlan lap =
      plan_tour(start.state, start.time, std::span(order_.points).subspan(first),
                std::span(courses_).subspan(first), air, options_.curves);
  Part part;
  if (lap.passes.empty()) {
    part.why_not = fmt::format(
        "the wind of {:.1f} m/s is too strong to fly through the points at "
        "{:.1f} m/s",
        air.wind.norm(), air.airspeed);
    return part;
  }
  planned_ += lap.passes.size();
  part.plan = std::move(lap.plan);
  part.milestones = std::move(lap.passes);
  part.last = planned_ >= visits();
  return part;
}

bool TourTask::finish(const TaskStep& step, AgentOutput& out) {
  passed_ = visits();
  out.events.push_back({step.in.now, context().self, EventKind::kRouteDone,
                        "the last point has been passed"});
  return true;
}

TaskProgress TourTask::progress(const AgentInput& in) const {
  TaskProgress progress = PlannedTask::progress(in);
  progress.share = static_cast<double>(passed_) / static_cast<double>(visits());
  return progress;
}

// In whole laps from the next point on.
TaskKind TourTask::rest() const {
  const std::size_t lap = order_.points.size(), left = visits() - passed_;
  if (passed_ == 0 || left == 0) return order_;
  FlyTour rest = order_;
  rest.laps = static_cast<int>((left + lap - 1) / lap);
  const auto next = static_cast<std::ptrdiff_t>(passed_ % lap);
  std::rotate(rest.points.begin(), rest.points.begin() + next, rest.points.end());
  return rest;
}

}  // namespace skein::reasoning
