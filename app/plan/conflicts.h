// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "app/plan/task.h"
#include "skein/data/airspace/airspace.h"
#include "skein/data/vehicle/flight_plan.h"

namespace skein::app {

/// Says on standard error what flights come into that their planner did not look at: of
/// each the first zone or moving obstacle. Adds them to `about` as `conflicts`.
/// @returns whether there is any.
bool report_conflicts(const std::vector<FlightPlan>& plans, const Airspace& airspace,
                      const TaskInput& task, nlohmann::ordered_json& about);

}  // namespace skein::app
