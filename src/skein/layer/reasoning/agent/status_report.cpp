#include "skein/layer/reasoning/agent/status_report.h"

#include <algorithm>

namespace skein::reasoning {

bool StatusReport::step(const AgentInput& in, const FlightLimits& limits,
                        const TaskProgress& progress, std::uint32_t zone_changes,
                        AgentOutput& out) {
  if (next_ && in.now < *next_) return false;
  // Even spacing, also when steps do not fall on the period.
  next_ = std::max(next_.value_or(in.now) + Time::from_seconds(period_), in.now);
  Message report;
  report.to = station_;
  report.content = AircraftReport{
      *in.nav,     limits, progress.number, progress.done, obeys_orders(in.autopilot),
      zone_changes};
  out.outbox.push_back(std::move(report));
  return true;
}

}  // namespace skein::reasoning
