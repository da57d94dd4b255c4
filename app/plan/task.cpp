// SPDX-License-Identifier: Apache-2.0
#include "app/plan/task.h"

#include <algorithm>

#include "app/plan/output.h"

namespace skein::app {

Result<TaskInput> read_task(const PlanSetting& given, const PlanLimits& given_limits,
                            const PlanStarts& given_starts, const PlanOutput& output,
                            const std::vector<std::filesystem::path>& inputs) {
  if (auto good = check_files(output, inputs); !good) return good.error();
  const auto place =
      place_of(given_starts.from_geo.empty() ? "" : given_starts.from_geo.front());
  if (!place) return place.error();
  const auto setting = read_setting(given, place.value());
  if (!setting) return setting.error();
  const auto limits = limits_of(given_limits, setting.value());
  if (!limits) return limits.error();
  const auto states =
      read_states("from", given_starts.from, given_starts.from_geo, setting.value());
  if (!states) return states.error();
  TaskInput task{setting.value(),
                 limits.value(),
                 {},
                 given.altitude.value_or(0),
                 given.altitude.has_value()};
  for (const ReadState& each : states.value()) {
    if (each.has_altitude != states.value().front().has_altitude)
      return Error{ErrorCode::kBadInput, "--from",
                   "some starts have an altitude and some have none.",
                   "Give all, or --altitude-m."};
    task.starts.push_back(each.state);
  }
  if (!given.altitude && !task.starts.empty() && states.value().front().has_altitude) {
    task.altitude = 0.0 - task.starts.front().p_N.z();
    task.has_altitude = true;
  }
  const exchange::Known known{task.setting.frame.has_value(), task.has_altitude,
                              std::max<std::size_t>(1, task.starts.size())};
  if (auto good = check_formats(output, known); !good) return good.error();
  return task;
}

}  // namespace skein::app
