#include "layer/reasoning/agent/route_agent.h"

#include <algorithm>

#include "layer/reasoning/agent/altitude.h"

namespace skein::reasoning {
namespace {

constexpr int kReportBytes = 48;  // on the air: id, time and content as fixed-point

}  // namespace

RouteAgent::RouteAgent(const RouteAgentOptions& options, EntityId self, EntityId station,
                       const FlightLimits& limits, const Terrain& map)
    : options_(options),
      self_(self),
      station_(station),
      limits_(limits),
      altitude_msl_(highest_along(map, options.points) + options.altitude_agl),
      execution_(options.safety_zone) {}

void RouteAgent::step(const AgentInput& in, AgentOutput& out) {
  if (!in.nav) return;
  if (!begun_) {
    FlyWaypoints way;
    way.laps = options_.laps;
    for (const Vec2& point : options_.points)
      way.points.push_back({point, altitude_msl_});
    AutopilotCommand command;
    command.guidance = std::move(way);
    command.altitude_msl = altitude_msl_;
    out.command = std::move(command);
  } else if (in.autopilot.done && !done_) {
    done_ = true;
    out.events.push_back({in.now, self_, "route-done", "the last point has been passed"});
  }
  begun_ = true;
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

}  // namespace skein::reasoning
