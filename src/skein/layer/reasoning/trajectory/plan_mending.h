// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/trajectory_step.h"

namespace skein::reasoning {

/// Whether what a plan still has after a time leads into a zone that counts.
bool comes_into_zone(const FlightPlan& plan, double after, const TrajectoryStep& step,
                     const FlightContext& context);

/// A plan that was blocked or left, made good.
struct MendedPlan {
  FlightPlan plan;  ///< from where the aircraft is; empty: none was found
  std::vector<double> milestones;
  std::string reason;  ///< what was done, or why nothing could be
};

/// Mends a plan leg by leg, each up to the first milestone that lies in no zone
/// (solve::repair): from where the aircraft is, then wherever the rest of it is
/// blocked.
/// @param milestones  growing times of the plan, its end last.
MendedPlan mend_plan(const FlightPlan& plan, const std::vector<double>& milestones,
                     const TrajectoryStep& step, const FlightContext& context);

}  // namespace skein::reasoning
