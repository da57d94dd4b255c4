// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/loiter_planner.h"

namespace skein::reasoning {

const FlightIntent* LoiterPlanner::plan(const FlightIntent*, const TaskStep& step,
                                        AgentOutput&) {
  if (!begun_ || left_)
    intent_.what = Circling{
        left_ ? geo::horizontal(step.in.nav->p_N) : step.safety.home(), {}, left_};
  begun_ = true;
  left_ = false;
  return &intent_;
}

void LoiterPlanner::replaced() {
  left_ = true;
}

}  // namespace skein::reasoning
