// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/patrol/patrol_task.h"

#include <algorithm>

#include "skein/model/path/flight_plan.h"
#include "skein/solve/touring/patrol.h"

namespace skein::reasoning {
namespace {

constexpr int kRoundsAtATime = 3;
constexpr double kWorthIt = 2;      // straight that is worth coming back to [s]
constexpr double kRounding = 1e-6;  // [s]

}  // namespace

PlannedTask::Part PatrolTask::plan_part(const Start& start, const TaskStep&) {
  if (flown().empty()) {
    planned_ = rounds_;
    ends_round_.clear();
  }
  solve::PatrolQuery query;
  query.line = order_.line;
  query.closed = order_.closed;
  query.offset = order_.offset;
  query.rounds = order_.rounds == 0
                     ? kRoundsAtATime
                     : std::clamp(order_.rounds - planned_, 1, kRoundsAtATime);
  query.altitude_msl = -start.state.p_N.z();
  query.start_time = start.time;
  query.starts = {start.state};
  // At cruise airspeed from the beginning: no aircraft changes it at once.
  query.limits = start.limits;
  query.limits.slowest = query.limits.fastest = start.limits.airspeed;
  query.wind = start.wind;
  solve::PatrolResult result = solve::plan_patrol(query);
  Part part;
  if (result.plans.empty() || result.plans.front().empty()) {
    part.why_not = result.reason;
    part.never = result.outcome == solve::PatrolOutcome::kBadLine ||
                 result.outcome == solve::PatrolOutcome::kBadPatrol;
    return part;
  }
  part.plan = std::move(result.plans.front());
  // Where the line is joined and left, so that detours come back to it.
  const double begin = result.begins.front(), end = model::end_time_of(part.plan);
  for (const FlightElement& e : part.plan)
    if (e.turn_rate == 0 && e.duration > kWorthIt && e.start >= begin - kRounding)
      for (const double time : {e.start, e.start + e.duration})
        if (part.milestones.empty() || time > part.milestones.back() + kRounding)
          part.milestones.push_back(time);
  if (part.milestones.empty() || part.milestones.back() < end - kRounding)
    part.milestones.push_back(end);
  double round = begin + result.round_time;
  for (const double time : part.milestones) {
    const bool over = time >= std::min(round, end) - kRounding;
    ends_round_.push_back(over);
    if (over) round += result.round_time;
  }
  planned_ += query.rounds;
  part.last = order_.rounds != 0 && planned_ >= order_.rounds;
  return part;
}

void PatrolTask::pass(const TaskStep&) {
  if (ends_round_.empty()) return;
  if (ends_round_.front()) ++rounds_;
  ends_round_.erase(ends_round_.begin());
}

TaskProgress PatrolTask::progress(const AgentInput& in) const {
  TaskProgress progress = PlannedTask::progress(in);
  if (!progress.done && order_.rounds > 0)
    progress.share = static_cast<double>(rounds_) / order_.rounds;
  return progress;
}

TaskKind PatrolTask::rest() const {
  Patrol rest = order_;
  if (rest.rounds > 0) rest.rounds = std::max(1, rest.rounds - rounds_);
  return rest;
}

}  // namespace skein::reasoning
