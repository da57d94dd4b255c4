// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/task_needs.h"

#include <utility>

#include "skein/layer/reasoning/team/onboard/packed_task.h"
#include "skein/layer/reasoning/team/protocol/allocation.h"

namespace skein::reasoning {
namespace {

constexpr double kEndless = 3600;  // a task without an end counts as so long [s]

}  // namespace

TaskNeeds needs_of(const TeamTask& task) {
  if (const auto what = unpacked(task)) return needs_of(*what);
  TaskNeeds needs;
  needs.begin = needs.centre = task.place;
  return needs;
}

TeamTask team_task(std::uint32_t number, const TaskKind& what, std::uint32_t sensors,
                   bool group, std::vector<std::uint32_t> after) {
  const TaskNeeds needs = needs_of(what);
  TeamTask task;
  task.number = number;
  task.place = needs.centre;
  task.single = !group;
  task.sensors = sensors | needs.sensors;
  task.what = packed(what);
  task.after = std::move(after);
  return task;
}

bool may_be_given(const TeamTask& task, const TeamResources& resources) {
  return (task.sensors & ~resources.sensors) == 0 && !refuses(resources, task.number);
}

std::optional<double> time_to_begin(const TaskNeeds& needs,
                                    const TeamResources& resources,
                                    const FlightConditions& conditions) {
  if (!needs.begin) return 0;
  return conditions.time(geo::horizontal(resources.place), *needs.begin, resources.speed);
}

std::optional<double> time_home(const TaskNeeds& needs, const TeamResources& resources,
                                const FlightConditions& conditions) {
  const Vec2 begin = needs.begin.value_or(geo::horizontal(resources.place));
  const Vec2 home(resources.home_north, resources.home_east);
  return conditions.time(needs.end.value_or(begin), home, resources.speed);
}

// Within the task it flies to and fro, with the wind and against it: V / (V^2 - w^2) for
// each metre.
std::optional<double> time_within(const TaskNeeds& needs, const TeamResources& resources,
                                  const FlightConditions& conditions) {
  const double stay = needs.stay + (needs.endless ? kEndless : 0);
  if (needs.length <= 0) return stay;
  const double left = resources.speed * resources.speed - conditions.wind().squaredNorm();
  if (left <= 0) return std::nullopt;
  return needs.length * resources.speed / left + stay;
}

}  // namespace skein::reasoning
