#include "skein/layer/reasoning/agent/zone_decorator.h"

#include <utility>

#include "skein/model/path/plan_curve.h"

namespace skein::reasoning {
namespace {

constexpr double kAhead = 3;  // whose bearing is the course of a plan [s]

// The course over ground that a command asks for just ahead [rad].
double course_of(const AutopilotCommand& command, const NavEstimate& nav) {
  if (const auto* hold = std::get_if<HoldCourse>(&command.guidance)) return hold->course;
  if (const auto* follow = std::get_if<FollowPlan>(&command.guidance)) {
    model::PlanCurve curve;
    curve.assign(follow->plan);
    const Vec2 ahead = geo::horizontal(curve.at(nav.time.seconds() + kAhead).p_N) -
                       geo::horizontal(nav.p_N);
    if (ahead.norm() > 1) return geo::bearing(ahead);
  }
  return geo::bearing(geo::horizontal(nav.v_N));
}

}  // namespace

ZoneDecorator::ZoneDecorator(const ZoneAvoidanceOptions& options, EntityId self,
                             const FlightLimits& limits, const Terrain& map,
                             std::span<const Zone> zones, std::unique_ptr<Agent> pilot)
    : zones_(options, limits, zones, self),
      returns_(options, limits, self, map),
      pilot_(std::move(pilot)) {}

void ZoneDecorator::step(const AgentInput& in, AgentOutput& out) {
  const bool news = zones_.listen(in, out);
  const std::size_t written = out.outbox.size();
  pilot_->step(in, out);
  for (std::size_t k = written; k < out.outbox.size(); ++k)
    if (auto* report = std::get_if<AircraftReport>(&out.outbox[k].content))
      report->zone_changes = zones_.changes_known();
  if (!in.nav) return;
  if (!home_) home_ = geo::horizontal(in.nav->p_N);
  returns_.step(in, *home_, zones_.zones(), news, out);
  shield(in, out);
}

void ZoneDecorator::shield(const AgentInput& in, AgentOutput& out) {
  if (out.command) setpoint_ = out.command;
  if (!setpoint_) return;
  const double altitude = setpoint_->altitude_msl;
  if (zones_.keeps_on_ground(in, altitude)) {
    held_ = true;
    out.command.reset();
    return;
  }
  if (std::exchange(held_, false)) out.command = setpoint_;
  if (in.autopilot.on_ground || zones_.zones().empty()) return;
  const bool was_deflecting = zones_.deflecting();
  auto guidance = zones_.keep_out(setpoint_->guidance, course_of(*setpoint_, *in.nav),
                                  *in.nav, altitude);
  zones_.look(in, out);
  if (zones_.deflecting())
    out.command = AutopilotCommand{std::move(guidance), altitude, setpoint_->airspeed};
  else if (was_deflecting)
    out.command = setpoint_;
}

}  // namespace skein::reasoning
