// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/plan/arguments.h"
#include "app/plan/input.h"

namespace skein::app {

/// What all tasks of one or several aircraft begin with.
struct TaskInput {
  ReadSetting setting;
  FlightLimits limits;
  std::vector<FlightState> starts;
  double altitude = 0;  ///< above mean sea level [m]; 0 where none is known
  bool has_altitude = false;
};

/// Reads setting, limits and starts; checks the names of the files to be written, which
/// must not be `inputs`, and whether their formats can say what is known. The task's
/// altitude is that of --altitude-m, else that of the first start.
/// Fails: as what it calls; kBadInput when only some starts have an altitude.
Result<TaskInput> read_task(const PlanSetting& setting, const PlanLimits& limits,
                            const PlanStarts& starts, const PlanOutput& output,
                            const std::vector<std::filesystem::path>& inputs);

}  // namespace skein::app
