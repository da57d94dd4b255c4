#include "skein/layer/reasoning/task/guided_task.h"

#include <utility>

#include "skein/base/math.h"
#include "skein/layer/reasoning/agent/altitude.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::reasoning {
namespace {

constexpr double kRadiusReserve = 1.1;  // of turn radii over ground: room to correct

}  // namespace

void GuidedTask::fly(const TaskStep& step, AgentOutput& out) {
  const NavEstimate& nav = *step.in.nav;
  AutopilotCommand command;
  command.altitude_msl =
      altitude_over(*context_.map, geo::horizontal(nav.p_N), geo::horizontal(nav.v_N),
                    context_.altitude_agl, context_.limits.climb_rate);
  const Setpoint next = next_setpoint(step, command.altitude_msl, out);
  command.guidance =
      step.safety.zones().keep_out(next.guidance, next.course, nav, command.altitude_msl);
  out.command = std::move(command);
}

double GuidedTask::wide_radius(const Vec2& wind) const {
  return kRadiusReserve * model::ground_turn_radius(context_.limits.turn_radius,
                                                    context_.limits.airspeed,
                                                    wind.norm());
}

GuidedTask::Setpoint GuidedTask::circle_at(const Vec2& centre,
                                           const NavEstimate& nav) const {
  const double radius = wide_radius(nav.wind_N);
  const Vec2 out = geo::horizontal(nav.p_N) - centre;
  // Tangential on the circle, straight to it from afar.
  const double course =
      geo::bearing(out) + geo::kPi / 2 + math::atan2(out.norm() - radius, radius);
  return {Circle{centre, radius, true}, course};
}

}  // namespace skein::reasoning
