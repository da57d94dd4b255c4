// SPDX-License-Identifier: Apache-2.0
#include "app/plan/conflicts.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/common/output.h"
#include "skein/solve/path/airspace_map.h"

namespace skein::app {

bool report_conflicts(const std::vector<FlightPlan>& plans, const Airspace& airspace,
                      const TaskInput& task, nlohmann::ordered_json& about) {
  PathQuery query;
  query.limits = task.limits;
  query.wind = task.setting.air.wind;
  query.airspace = &airspace;
  const solve::AirspaceMap map(query);
  auto conflicts = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < plans.size(); ++k) {
    if (plans[k].empty()) continue;
    const auto conflict = map.first_conflict(plans[k]);
    if (!conflict) continue;
    const std::string who =
        plans.size() == 1 ? "the flight" : fmt::format("aircraft {}", k + 1);
    complain("note: {} is {}.\n", who, conflict->what);
    conflicts.push_back(
        {{"aircraft", k + 1}, {"time_s", conflict->time}, {"what", conflict->what}});
  }
  const bool any = !conflicts.empty();
  if (any) about["conflicts"] = std::move(conflicts);
  return any;
}

}  // namespace skein::app
