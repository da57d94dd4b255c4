#include "skein/layer/reasoning/task/route_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "skein/layer/reasoning/agent/altitude.h"

namespace skein::reasoning {
namespace {

constexpr double kNearlyDown = 10;  // above the ground: a landing is finished [m]
// Of the range of speeds, for a leader: the rest is for followers, outside of turns and
// behind.
constexpr double kLeaderSpeed = 0.4;
constexpr double kReportPeriod = 1;  // of its position, to followers [s]

RouteFlightOptions flight_options(const TaskContext& context, const FlyRoute& order,
                                  double altitude_msl) {
  RouteFlightOptions flight;
  flight.points = order.points;
  flight.laps = order.laps;
  flight.altitude_msl = altitude_msl;
  flight.ground_clearance = context.altitude_agl / 2;
  const FlightLimits& limits = context.limits;
  if (!order.report_to.empty() && limits.slowest > 0)
    flight.airspeed =
        std::min(limits.airspeed,
                 limits.slowest + kLeaderSpeed * (limits.fastest - limits.slowest));
  return flight;
}

}  // namespace

RouteTask::RouteTask(const TaskContext& context, const FlyRoute& order, bool lands)
    : self_(context.self),
      map_(*context.map),
      report_to_(order.report_to),
      first_(order.points.front()),
      lands_(lands),
      altitude_msl_(highest_along(map_, order.points) + context.altitude_agl),
      flight_(flight_options(context, order, altitude_msl_),
              {context.limits, context.map, context.planner}, self_) {}

void RouteTask::listen(const TaskStep& step) {
  land_again_ = land_again_ || step.safety.news();
}

void RouteTask::fly(const TaskStep& step, AgentOutput& out) {
  report(step, out);
  if (done_ && lands_) return land(step, out);
  flight_.step(step.in, step.safety.zones(), step.safety.off_plan(), out);
  if (done_ || !flight_.done()) return;
  done_ = true;
  out.events.push_back({step.in.now, self_, "route-done", flight_.ending()});
  if (lands_) land(step, out);
}

void RouteTask::report(const TaskStep& step, AgentOutput& out) {
  const Time now = step.in.now;
  if (report_to_.empty() || (next_report_ && now < *next_report_)) return;
  next_report_ =
      std::max(next_report_.value_or(now) + Time::from_seconds(kReportPeriod), now);
  for (const EntityId id : report_to_) {
    Message message;
    message.to = id;
    message.content = TeamPosition{self_, *step.in.nav};
    out.outbox.push_back(std::move(message));
  }
}

// At home, or at the nearest place that no zone forbids; anew when zones have changed.
void RouteTask::land(const TaskStep& step, AgentOutput& out) {
  if (landing_point_ && !std::exchange(land_again_, false)) return;
  const Vec2 home = step.safety.began_on_ground() ? step.safety.home() : first_;
  const Vec2 place = step.safety.returns().allowed(home);
  const double ground = map_.elevation_msl(place);
  const bool nearly_down = -step.in.nav->p_N.z() - ground < kNearlyDown;
  if (landing_point_ && (place == *landing_point_ || nearly_down)) return;
  landing_point_ = place;
  if (place != home)
    out.events.push_back({step.in.now, self_, "return-moved",
                          fmt::format("lands at {:.0f} m north, {:.0f} m east, out of a "
                                      "no-fly zone",
                                      place.x(), place.y())});
  AutopilotCommand command;
  command.altitude_msl = altitude_msl_;
  command.guidance = Land{place, ground};
  out.command = std::move(command);
}

}  // namespace skein::reasoning
