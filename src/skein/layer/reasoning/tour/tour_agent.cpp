#include "skein/layer/reasoning/tour/tour_agent.h"

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

TourAgent::TourAgent(const TourAgentOptions& options, EntityId self, EntityId station,
                     const FlightLimits& limits, const Terrain& map)
    : options_(options),
      self_(self),
      limits_(limits),
      altitude_msl_(highest_along(map, options.points) + options.altitude_agl),
      courses_(corner_courses(options.points)),
      execution_(options.safety_zone),
      report_(station, options.report_period) {}

void TourAgent::step(const AgentInput& in, AgentOutput& out) {
  if (!in.nav) return;
  if (!launch_.takes_off(in, altitude_msl_, out)) fly(in, out);
  if (auto event = execution_.check(in.now, self_, in.autopilot)) {
    out.events.push_back(*std::move(event));
    if (execution_.off_plan() && options_.replans && !done_)
      forget_plan(in.now.seconds());
  }
  report_.step(in, limits_, done_, 0, out);
}

void TourAgent::fly(const AgentInput& in, AgentOutput& out) {
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

std::size_t TourAgent::visits() const {
  return options_.points.size() * static_cast<std::size_t>(options_.laps);
}

// The points that have not been passed are planned anew.
void TourAgent::forget_plan(double now) {
  plan_.clear();
  while (!passes_.empty() && passes_.back() > now) passes_.pop_back();
}

// Adds to the plan what is left of the lap, and flies it.
void TourAgent::plan_on(const AgentInput& in, const FlightState& from, double start,
                        AgentOutput& out) {
  const model::AirMotion air{
      limits_.airspeed, options_.radius_factor * limits_.turn_radius, in.nav->wind_N};
  const std::size_t first = passes_.size() % options_.points.size();
  const TourPlan next =
      plan_tour(from, start, std::span(options_.points).subspan(first),
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
