#include "skein/layer/reasoning/agent/position_report.h"

#include <algorithm>

namespace skein::reasoning {
void PositionReport::step(const AgentInput& in, const FlightLimits& limits, bool done,
                          std::uint32_t zone_changes, AgentOutput& out) {
  if (in.now < next_) return;
  next_ = std::max(next_ + Time::from_seconds(period_), in.now);
  Message report;
  report.to = station_;
  report.content =
      AircraftReport{*in.nav, limits, 0, done, obeys_orders(in.autopilot), zone_changes};
  out.outbox.push_back(std::move(report));
}

}  // namespace skein::reasoning
