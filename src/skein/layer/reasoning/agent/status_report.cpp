// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/status_report.h"

#include <algorithm>

#include "skein/layer/reasoning/agent/report_rate.h"

namespace skein::reasoning {
namespace {

// Reports with limits: those until an order shows that they have arrived, and later.
constexpr std::uint32_t kLimitsAtFirst = 3, kLimitsWithoutOrder = 5, kLimitsEvery = 20;

}  // namespace

// The more room there is for reports, the sooner the next one.
void StatusReport::pass(Time now, double share) {
  if (!last_) {
    if (share < 1) left_ = Time::from_seconds(period_ * ReportRate::phase(self_));
  } else {
    const Time step = now - *last_;
    left_ = left_ - (share < 1 ? Time::from_seconds(step.seconds() * share) : step);
  }
  last_ = now;
}

bool StatusReport::is_due(const TaskPlanner& tasks, double share) const {
  if (left_ <= Time()) return true;
  if (share >= 1) return false;
  return tasks.order() != said_order_ ||
         (tasks.order() > 0 && tasks.state() != said_state_);
}

bool StatusReport::step(const AgentInput& in, const FlightLimits& limits,
                        const TaskPlanner& tasks, std::uint32_t zone_changes,
                        double share, AgentOutput& out) {
  pass(in.now, share);
  if (!is_due(tasks, share)) return false;
  // Even spacing, also when steps do not fall on the period.
  const Time period = Time::from_seconds(period_);
  left_ = std::max(left_ > Time() ? period : left_ + period, Time());
  const TaskProgress progress = tasks.progress(in);
  AircraftReport content;
  content.nav = *in.nav;
  // They do not change, but a report may be lost; nobody counts on it without them.
  const std::uint32_t every = tasks.order() == 0 ? kLimitsWithoutOrder : kLimitsEvery;
  if (reports_ < kLimitsAtFirst || reports_ % every == 0) content.limits = limits;
  ++reports_;
  content.task_number = tasks.order();
  content.task_state = tasks.order() > 0 ? tasks.state() : TaskState::kNone;
  content.obeys = obeys_orders(in.autopilot);
  content.zone_changes = zone_changes;
  content.task_share = progress.share;
  content.task_time_to_go = progress.time_to_go;
  if (share < 1) content.next_in = period_ / share;
  said_order_ = content.task_number;
  said_state_ = content.task_state;
  Message report;
  report.to = station_;
  report.content = content;
  out.outbox.push_back(std::move(report));
  return true;
}

}  // namespace skein::reasoning
