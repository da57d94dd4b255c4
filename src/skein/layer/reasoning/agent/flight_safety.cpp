#include "skein/layer/reasoning/agent/flight_safety.h"

#include <utility>

#include "skein/model/path/plan_curve.h"

namespace skein::reasoning {
namespace {

constexpr double kCourseAhead = 3;  // whose bearing is the course of a plan [s]

// The course over ground that a command asks for just ahead [rad].
double course_of(const AutopilotCommand& command, const NavEstimate& nav) {
  if (const auto* hold = std::get_if<HoldCourse>(&command.guidance)) return hold->course;
  if (const auto* follow = std::get_if<FollowPlan>(&command.guidance)) {
    model::PlanCurve curve;
    curve.assign(follow->plan);
    const Vec2 ahead = geo::horizontal(curve.at(nav.time.seconds() + kCourseAhead).p_N) -
                       geo::horizontal(nav.p_N);
    if (ahead.norm() > 1) return geo::bearing(ahead);
  }
  return geo::bearing(geo::horizontal(nav.v_N));
}

}  // namespace

bool FlightSafety::may_fly(const AgentInput& in, double altitude_msl, AgentOutput& out) {
  if (!home_) {
    home_ = geo::horizontal(in.nav->p_N);
    began_on_ground_ = in.autopilot.on_ground;
  }
  returns_.step(in, *home_, zones_.zones(), news_, out);
  return !zones_.keeps_on_ground(in, altitude_msl) &&
         !launch_.takes_off(in, altitude_msl, out);
}

void FlightSafety::keep_out(const AgentInput& in, AgentOutput& out) {
  if (out.command) setpoint_ = out.command;
  if (!setpoint_ || in.autopilot.on_ground || zones_.zones().empty()) return;
  const bool was_deflecting = zones_.deflecting();
  auto guidance = zones_.keep_out(setpoint_->guidance, course_of(*setpoint_, *in.nav),
                                  *in.nav, setpoint_->altitude_msl);
  if (zones_.deflecting())
    out.command = AutopilotCommand{std::move(guidance), setpoint_->altitude_msl,
                                   setpoint_->airspeed};
  else if (was_deflecting)
    out.command = setpoint_;
}

void FlightSafety::finish(const AgentInput& in, AgentOutput& out) {
  zones_.look(in, out);
  if (auto event = execution_.check(in.now, self_, in.autopilot))
    out.events.push_back(*std::move(event));
}

}  // namespace skein::reasoning
