// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/task_needs.h"

#include <cmath>
#include <utility>
#include <vector>

#include "skein/geo/polygon.h"
#include "skein/layer/reasoning/team/onboard/packed_task.h"
#include "skein/layer/reasoning/team/protocol/allocation.h"

namespace skein::reasoning {
namespace {

constexpr double kEndless = 3600;  // a task without an end counts as so long [s]

double length_of(const std::vector<Vec2>& points, bool closed) {
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k)
    length += (points[k] - points[k - 1]).norm();
  if (closed && points.size() > 1) length += (points.front() - points.back()).norm();
  return length;
}

Vec2 middle_of(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = low;
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (low + high) / 2;
}

// Along points that it begins at, some times over; it ends at the last of a line.
TaskNeeds along(const std::vector<Vec2>& points, double length, bool line = false) {
  TaskNeeds needs;
  if (points.empty()) return needs;
  needs.begin = points.front();
  if (line) needs.end = points.back();
  needs.centre = middle_of(points);
  needs.length = length;
  return needs;
}

TaskNeeds at(const Vec2& point, double stay) {
  TaskNeeds needs;
  needs.begin = needs.centre = point;
  needs.stay = stay;
  return needs;
}

TaskNeeds endless(TaskNeeds needs) {
  needs.endless = true;
  return needs;
}

struct NeedsOfKind {
  TaskNeeds operator()(const Loiter& t) const { return endless(at(t.centre, 0)); }
  TaskNeeds operator()(const FlyTo& t) const { return at(t.point, 0); }
  TaskNeeds operator()(const FollowEdge& t) const {
    TaskNeeds needs = endless(at(t.start, 0));
    needs.sensors = kFireSensor;
    return needs;
  }
  TaskNeeds operator()(const FollowLine& t) const {
    return along(t.points, length_of(t.points, false), true);
  }
  TaskNeeds operator()(const FlyCourse&) const { return endless({}); }
  TaskNeeds operator()(const FlyRoute& t) const {
    return along(t.points, t.laps * length_of(t.points, true));
  }
  TaskNeeds operator()(const FollowLeader&) const { return endless({}); }
  TaskNeeds operator()(const FlyTour& t) const {
    return along(t.points, t.laps * length_of(t.points, true));
  }
  TaskNeeds operator()(const Hold&) const { return endless({}); }
  TaskNeeds operator()(const Survey& t) const {
    const double spacing = t.swath * (1 - t.overlap);
    return along(t.area, std::abs(geo::signed_area(t.area)) / spacing);
  }
  TaskNeeds operator()(const Patrol& t) const {
    const double round =
        t.closed ? length_of(t.line, true) : 2 * length_of(t.line, false);
    TaskNeeds needs = along(t.line, t.rounds * round);
    needs.endless = t.rounds == 0;
    return needs;
  }
  TaskNeeds operator()(const Orbit& t) const {
    TaskNeeds needs = at(t.point, t.duration);
    needs.endless = t.duration <= 0;
    if (t.object) needs.sensors = kCameraSensor;
    needs.better_hovering = true;
    return needs;
  }
  TaskNeeds operator()(const Measure& t) const {
    TaskNeeds needs = at(t.point, t.stay);
    needs.better_hovering = true;
    return needs;
  }
  TaskNeeds operator()(const Rendezvous& t) const { return endless(at(t.point, 0)); }
  TaskNeeds operator()(const Relay&) const { return endless({}); }
  TaskNeeds operator()(const FlyPlan& t) const {
    if (t.plan.empty()) return {};
    TaskNeeds needs = at(geo::horizontal(t.plan.front().p_N), 0);
    needs.end = geo::horizontal(t.plan.back().p_N);
    for (const FlightElement& element : t.plan) needs.stay += element.duration;
    return needs;
  }
  TaskNeeds operator()(const ReturnHome&) const { return endless({}); }
  TaskNeeds operator()(const LandAt& t) const {
    return t.at_home ? endless({}) : endless(at(t.place, 0));
  }
};

}  // namespace

TaskNeeds needs_of(const TaskKind& task) {
  return std::visit(NeedsOfKind{}, task);
}

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
