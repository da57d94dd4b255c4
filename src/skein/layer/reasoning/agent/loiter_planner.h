// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/agent/planner_chain.h"

namespace skein::reasoning {

/// The first planner of the chain: a circle that can always be flown. It is around home
/// until something else has been flown; then around where the aircraft was when that left
/// it with nothing to fly.
class LoiterPlanner final : public PlannerOfChain {
 public:
  const FlightIntent* plan(const FlightIntent* given, const TaskStep& step,
                           AgentOutput& out) override;
  void replaced() override;
  std::string_view reason() const override { return {}; }

 private:
  FlightIntent intent_;
  bool begun_ = false;  // there is a place to circle
  bool left_ = false;   // something else has been flown since
};

}  // namespace skein::reasoning
