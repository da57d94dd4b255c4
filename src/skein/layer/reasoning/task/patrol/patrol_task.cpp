#include "skein/layer/reasoning/task/patrol/patrol_task.h"

#include <algorithm>

#include "skein/layer/reasoning/planning/tasks/patrol.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr int kRoundsAtATime = 3;

}  // namespace

PlannedTask::Part PatrolTask::plan_part(const Start& start, const TaskStep&) {
  if (flown().empty()) {
    planned_ = rounds_;
    ends_round_.clear();
  }
  planning::PatrolQuery query;
  query.line = order_.line;
  query.closed = order_.closed;
  query.offset = order_.offset;
  query.rounds = order_.rounds == 0
                     ? kRoundsAtATime
                     : std::clamp(order_.rounds - planned_, 1, kRoundsAtATime);
  query.altitude_msl = -start.state.p_N.z();
  query.start_time = start.time;
  query.starts = {start.state};
  query.limits = start.limits;
  query.wind = start.wind;
  planning::PatrolResult result = planning::plan_patrol(query);
  Part part;
  if (result.plans.empty() || result.plans.front().empty()) {
    part.why_not = result.reason;
    part.never = result.outcome == planning::PatrolOutcome::kBadLine ||
                 result.outcome == planning::PatrolOutcome::kBadPatrol;
    return part;
  }
  part.plan = std::move(result.plans.front());
  const double end = model::end_time_of(part.plan);
  part.milestones.push_back(result.begins.front());
  ends_round_.push_back(false);
  for (int k = 1; k <= query.rounds; ++k) {
    const double time = result.begins.front() + k * result.round_time;
    part.milestones.push_back(k == query.rounds ? end : std::min(time, end));
    ends_round_.push_back(true);
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
