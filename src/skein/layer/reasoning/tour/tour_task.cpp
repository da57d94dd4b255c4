#include "skein/layer/reasoning/tour/tour_task.h"

#include <fmt/format.h>

#include "skein/layer/reasoning/agent/altitude.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kPlanAgain = 10;  // after a plan that was refused [s]
constexpr double kAhead = 10;      // the next lap is planned when this little is left [s]

// What of a plan is not over yet.
FlightPlan rest_of(const FlightPlan& plan, double now) {
  FlightPlan rest;
  for (const FlightElement& e : plan)
    if (e.start + e.duration > now) rest.push_back(e);
  return rest;
}

}  // namespace

TourTask::TourTask(const TaskContext& context, const FlyTour& order,
                   const TourOptions& options)
    : options_(options),
      self_(context.self),
      limits_(context.limits),
      order_(order),
      altitude_msl_(highest_along(*context.map, order.points) + context.altitude_agl),
      courses_(corner_courses(order.points)) {}

void TourTask::fly(const TaskStep& step, AgentOutput& out) {
  const bool off_plan = step.safety.off_plan();
  if (off_plan && !was_off_plan_ && options_.replans && !done_)
    forget_plan(step.in.now.seconds());
  was_off_plan_ = off_plan;
  fly_plan(step.in, out);
  step.safety.keep_out(step.in, out);
}

void TourTask::fly_plan(const AgentInput& in, AgentOutput& out) {
  if (done_) return;
  if (!begin_) {
    begin_ = in.now + Time::from_seconds(options_.settling);
    AutopilotCommand wait;
    wait.guidance = HoldPosition{geo::horizontal(in.nav->p_N)};
    wait.altitude_msl = altitude_msl_;
    out.command = wait;
  }
  if (in.now < *begin_) return;
  const double now = in.now.seconds();
  if (!plan_.empty() && in.command_fate.state == CommandFate::State::kRefused) {
    // The autopilot has reported why; it goes on with what it flew before.
    forget_plan(now);
    begin_ = in.now + Time::from_seconds(kPlanAgain);
    return;
  }
  if (plan_.empty()) {
    // From where it is, however it got there.
    const Vec3 here(in.nav->p_N.x(), in.nav->p_N.y(), -altitude_msl_);
    plan_on(in, {here, in.nav->heading}, now, out);
    return;
  }
  const double end = model::end_time_of(plan_);
  if (now <= end - kAhead) return;
  if (passes_.size() < visits()) {
    const model::FlightMoment last = model::end_of(plan_.back());
    plan_ = rest_of(plan_, now);
    plan_on(in, {last.p_N, last.heading}, end, out);
  } else if (in.autopilot.done) {
    done_ = true;
    out.events.push_back({in.now, self_, "route-done", "the last point has been passed"});
  }
}

std::size_t TourTask::visits() const {
  return order_.points.size() * static_cast<std::size_t>(order_.laps);
}

// The points that have not been passed are planned anew.
void TourTask::forget_plan(double now) {
  plan_.clear();
  while (!passes_.empty() && passes_.back() > now) passes_.pop_back();
}

// Adds to the plan what is left of the lap, and flies it.
void TourTask::plan_on(const AgentInput& in, const FlightState& from, double start,
                       AgentOutput& out) {
  const model::AirMotion air{
      limits_.airspeed, options_.radius_factor * limits_.turn_radius, in.nav->wind_N};
  const std::size_t first = passes_.size() % order_.points.size();
  const TourPlan next =
      plan_tour(from, start, std::span(order_.points).subspan(first),
                std::span(courses_).subspan(first), air, options_.curves);
  const bool stuck = next.passes.empty();
  if (stuck && !stuck_)
    out.events.push_back(
        {in.now, self_, "no-plan",
         fmt::format("the wind of {:.1f} m/s is too strong to fly through the points at "
                     "{:.1f} m/s",
                     air.wind.norm(), air.airspeed)});
  stuck_ = stuck;
  if (stuck) return;
  plan_.insert(plan_.end(), next.plan.begin(), next.plan.end());
  passes_.insert(passes_.end(), next.passes.begin(), next.passes.end());
  AutopilotCommand command;
  command.guidance = FollowPlan{model::sample(plan_)};
  command.altitude_msl = altitude_msl_;
  if (!options_.keeps_times) command.airspeed = limits_.airspeed;
  out.command = std::move(command);
}

}  // namespace skein::reasoning
