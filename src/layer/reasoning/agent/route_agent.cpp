#include "layer/reasoning/agent/route_agent.h"

#include <algorithm>

#include "layer/reasoning/agent/altitude.h"
#include "layer/reasoning/agent/round_trip.h"

namespace skein::reasoning {
namespace {

constexpr int kReportBytes = 48;  // on the air: id, time and content as fixed-point

}  // namespace

RouteAgent::RouteAgent(const RouteAgentOptions& options, EntityId self, EntityId station,
                       const FlightLimits& limits, const Terrain& map,
                       std::span<const Zone> zones)
    : options_(options),
      self_(self),
      station_(station),
      limits_(limits),
      map_(map),
      altitude_msl_(highest_along(map, options.points) + options.altitude_agl),
      execution_(options.safety_zone),
      zones_(options.guard, limits, zones, self) {}

void RouteAgent::step(const AgentInput& in, AgentOutput& out) {
  if (!in.nav) return;
  if (!home_)
    home_ =
        in.autopilot.on_ground ? geo::horizontal(in.nav->p_N) : options_.points.front();
  if (!launch_.under_way(in, altitude_msl_, out)) fly(in, out);
  zones_.look(in, out);
  if (auto event = execution_.check(in.now, self_, in.autopilot))
    out.events.push_back(*std::move(event));
  if (in.now < next_report_) return;
  next_report_ =
      std::max(next_report_ + Time::from_seconds(options_.report_period), in.now);
  Message report;
  report.to = station_;
  report.size_bytes = kReportBytes;
  report.content = AircraftReport{*in.nav, limits_, 0, done_, obeys_orders(in.autopilot)};
  out.outbox.push_back(std::move(report));
}

void RouteAgent::fly(const AgentInput& in, AgentOutput& out) {
  if (begun_ && (done_ || !in.autopilot.done)) return;
  AutopilotCommand command;
  command.altitude_msl = altitude_msl_;
  if (!begun_) {
    begun_ = true;
    command.guidance = round_trip(options_.points, options_.laps, altitude_msl_);
    out.command = std::move(command);
    return;
  }
  done_ = true;
  out.events.push_back({in.now, self_, "route-done", "the last point has been passed"});
  if (!options_.lands) return;
  command.guidance = Land{*home_, map_.elevation_msl(*home_)};
  out.command = std::move(command);
}

}  // namespace skein::reasoning
