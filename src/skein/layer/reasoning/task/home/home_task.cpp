// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/home/home_task.h"

#include "skein/layer/reasoning/trajectory/altitude.h"

namespace skein::reasoning {
namespace {

TaskProgress when(bool done) {
  TaskProgress progress;
  progress.done = done;
  progress.share = done ? 1 : 0;
  return progress;
}

// So high above all ground on the straight line there.
double altitude_to(const Vec2& place, const NavEstimate& nav,
                   const FlightContext& context) {
  return highest_along(*context.map, {geo::horizontal(nav.p_N), place}) +
         context.altitude_agl;
}

}  // namespace

const FlightIntent* ReturnTask::plan(const TaskStep& step, AgentOutput&) {
  if (intent_.number == 0) {
    intent_.number = step.intents.next();
    intent_.what = Returning{altitude_to(step.safety.home(), *step.in.nav, context_)};
  }
  done_ = done_ || (step.flight.number == intent_.number && step.flight.done);
  return &intent_;
}

TaskProgress ReturnTask::progress(const AgentInput&) const {
  return when(done_);
}

const FlightIntent* LandTask::plan(const TaskStep& step, AgentOutput&) {
  if (intent_.number == 0) {
    const Vec2 place = order_.at_home ? step.safety.home() : order_.place;
    intent_.number = step.intents.next();
    intent_.what = Landing{place, altitude_to(place, *step.in.nav, context_)};
  }
  done_ = done_ || step.in.autopilot.on_ground;
  return &intent_;
}

TaskProgress LandTask::progress(const AgentInput&) const {
  return when(done_);
}

}  // namespace skein::reasoning
