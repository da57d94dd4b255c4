// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/agent_step.h"
#include "skein/layer/reasoning/trajectory/return_planner.h"
#include "skein/layer/reasoning/trajectory/zone_monitor.h"

namespace skein::reasoning {

/// What the planner of trajectories is given at one step.
struct TrajectoryStep {
  const AgentInput& in;  ///< with a navigation estimate
  ZoneMonitor& zones;
  const ReturnPlanner& returns;
  bool off_plan = false;       ///< the flight has left the safety zone of its plan
  bool zones_changed = false;  ///< other zones are in force since this step
};

}  // namespace skein::reasoning
