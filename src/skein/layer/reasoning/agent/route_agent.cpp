#include "skein/layer/reasoning/agent/route_agent.h"

#include <fmt/format.h>

#include <utility>

#include "skein/layer/reasoning/agent/altitude.h"

namespace skein::reasoning {
namespace {

constexpr double kNearlyDown = 10;  // above the ground: a landing is finished [m]

RouteFlightOptions flight_options(const RouteAgentOptions& options, double altitude) {
  RouteFlightOptions flight;
  flight.points = options.points;
  flight.laps = options.laps;
  flight.altitude_msl = altitude;
  flight.ground_clearance = options.altitude_agl / 2;
  return flight;
}

}  // namespace

RouteAgent::RouteAgent(const RouteAgentOptions& options, EntityId self, EntityId station,
                       const FlightLimits& limits, const Terrain& map,
                       std::span<const Zone> zones,
                       std::shared_ptr<const PathPlanner> planner)
    : options_(options),
      self_(self),
      limits_(limits),
      map_(map),
      altitude_msl_(highest_along(map, options.points) + options.altitude_agl),
      execution_(options.safety_zone),
      zones_(options.avoidance, limits, zones, self),
      returns_(options.avoidance, limits, self, map),
      flight_(flight_options(options, altitude_msl_), {limits, &map_, std::move(planner)},
              self),
      report_(station, options.report_period) {}

void RouteAgent::step(const AgentInput& in, AgentOutput& out) {
  const bool news = zones_.listen(in, out);
  if (!in.nav) return;
  if (!start_) {
    start_ = geo::horizontal(in.nav->p_N);
    home_ = in.autopilot.on_ground ? *start_ : options_.points.front();
  }
  land_again_ = land_again_ || news;
  returns_.step(in, *start_, zones_.zones(), news, out);
  if (!zones_.keeps_on_ground(in, altitude_msl_) &&
      !launch_.takes_off(in, altitude_msl_, out))
    fly(in, out);
  zones_.look(in, out);
  if (auto event = execution_.check(in.now, self_, in.autopilot))
    out.events.push_back(*std::move(event));
  report_.step(in, limits_, done_, zones_.changes_known(), out);
}

void RouteAgent::fly(const AgentInput& in, AgentOutput& out) {
  if (done_ && options_.lands) return land(in, out);
  flight_.step(in, zones_, execution_.off_plan(), out);
  if (done_ || !flight_.done()) return;
  done_ = true;
  out.events.push_back({in.now, self_, "route-done", flight_.ending()});
  if (options_.lands) land(in, out);
}

// At home, or at the nearest place that no zone forbids; anew when zones have changed.
void RouteAgent::land(const AgentInput& in, AgentOutput& out) {
  if (landing_point_ && !std::exchange(land_again_, false)) return;
  const Vec2 place = returns_.allowed(home_);
  const double ground = map_.elevation_msl(place);
  const bool nearly_down = -in.nav->p_N.z() - ground < kNearlyDown;
  if (landing_point_ && (place == *landing_point_ || nearly_down)) return;
  landing_point_ = place;
  if (place != home_)
    out.events.push_back({in.now, self_, "return-moved",
                          fmt::format("lands at {:.0f} m north, {:.0f} m east, out of a "
                                      "no-fly zone",
                                      place.x(), place.y())});
  AutopilotCommand command;
  command.altitude_msl = altitude_msl_;
  command.guidance = Land{place, ground};
  out.command = std::move(command);
}

}  // namespace skein::reasoning
