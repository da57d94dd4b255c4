// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/measure/measure_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace skein::reasoning {

void MeasureTask::listen(const TaskStep& step) {
  now_ = step.in.now;
  if (!arrived_ || done()) return;
  for (const FireReading& reading : step.readings) {
    ++readings_;
    inside_ += reading.inside ? 1 : 0;
  }
  ++winds_;
  wind_ += step.in.nav->wind_N;
}

const FlightIntent* MeasureTask::before(const TaskStep& step, AgentOutput& out) {
  const FlightIntent* own = GoToTask::before(step, out);
  if (own || !arrived_) return own;
  if ((step.in.now - *arrived_).seconds() >= order_.stay) {
    report(step, out);
    set_done();
    return nullptr;
  }
  circling_.what = Circling{place(), {}};
  return &circling_;
}

bool MeasureTask::finish(const TaskStep& step, AgentOutput& out) {
  if (GoToTask::finish(step, out)) arrived_ = step.in.now;
  return false;
}

void MeasureTask::report(const TaskStep& step, AgentOutput& out) const {
  const Vec2 wind = winds_ > 0 ? Vec2(wind_ / winds_) : step.in.nav->wind_N;
  std::string text = fmt::format(
      "at {:.0f} m north, {:.0f} m east for {:.0f} s: wind {:.1f} m/s from "
      "{:.0f} degrees",
      place().x(), place().y(), order_.stay, wind.norm(),
      geo::degrees(geo::wrap_2pi(geo::bearing(-wind))));
  if (readings_ > 0)
    text += fmt::format(", {} of {} fire readings inside", inside_, readings_);
  out.events.push_back(
      {step.in.now, context().self, EventKind::kMeasured, std::move(text)});
}

TaskProgress MeasureTask::progress(const AgentInput& in) const {
  TaskProgress progress = GoToTask::progress(in);
  if (progress.done) return progress;
  if (!arrived_) {
    if (progress.time_to_go) *progress.time_to_go += order_.stay;
    progress.share = 0;
    return progress;
  }
  const double stayed = (now_ - *arrived_).seconds();
  progress.share = order_.stay > 0 ? std::clamp(stayed / order_.stay, 0.0, 1.0) : 1;
  progress.time_to_go = std::max(0.0, order_.stay - stayed);
  return progress;
}

TaskKind MeasureTask::rest() const {
  return Measure{point(), order_.stay};
}

}  // namespace skein::reasoning
