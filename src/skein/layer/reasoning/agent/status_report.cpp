#include "skein/layer/reasoning/agent/status_report.h"

#include <algorithm>

namespace skein::reasoning {

bool StatusReport::step(const AgentInput& in, const FlightLimits& limits,
                        const TaskPlanner& tasks, std::uint32_t zone_changes,
                        double share, AgentOutput& out) {
  if (next_ && in.now < *next_) return false;
  // Even spacing, also when steps do not fall on the period.
  next_ = std::max(next_.value_or(in.now) + Time::from_seconds(period_ / share), in.now);
  const TaskProgress progress = tasks.progress(in);
  AircraftReport content;
  content.nav = *in.nav;
  content.limits = limits;
  content.task_number = tasks.order();
  content.task_state = tasks.order() > 0 ? tasks.state() : TaskState::kNone;
  content.obeys = obeys_orders(in.autopilot);
  content.zone_changes = zone_changes;
  content.task_share = progress.share;
  content.task_time_to_go = progress.time_to_go;
  Message report;
  report.to = station_;
  report.content = content;
  out.outbox.push_back(std::move(report));
  return true;
}

}  // namespace skein::reasoning
