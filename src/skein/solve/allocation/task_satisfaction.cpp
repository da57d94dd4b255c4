// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/task_satisfaction.h"

#include <algorithm>

#include "skein/base/math.h"

namespace skein::solve {
namespace {

constexpr double kCovered = 0.8;   // of a swath: the rest overlaps
constexpr double kNearTurn = 100;  // radius of turn that halves tracking [m]
constexpr double kTooFast = 10;    // [m/s] above a target by which tracking falls to 1/e
constexpr double kReserve = 1.2;   // of a route's time
constexpr double kMaxReserve = 1.5;  // more endurance than that is of no use
constexpr double kRelayRange = 0.8;  // of the radio's

using Aircraft = std::vector<TeamAircraft>;

const TeamSensor* sensor_of(const TeamAircraft& aircraft, const std::string& kind) {
  const auto found = aircraft.sensors.find(kind);
  return found == aircraft.sensors.end() ? nullptr : &found->second;
}

// What each aircraft brings to a task.
struct Brings {
  const TeamAircraft& aircraft;
  std::size_t index;
  Vec2 place;  // of the task

  double operator()(const SurveillanceTask& task) const {
    const TeamSensor* sensor = sensor_of(aircraft, task.sensor);
    if (!sensor) return 0;
    return kCovered * sensor->swath * aircraft.cruise * aircraft.endurance / task.area;
  }
  double operator()(const TrackingTask& task) const {
    const TeamSensor* sensor = sensor_of(aircraft, task.sensor);
    if (!sensor || aircraft.v_max < task.speed) return 0;
    const double excess = aircraft.v_min - task.speed;
    const double slow = excess <= 0 ? 1 : math::exp(-excess / kTooFast);
    return 2 * sensor->quality * slow / (1 + aircraft.turn_radius / kNearTurn);
  }
  double operator()(const PatrolTask& task) const {
    return task.revisit * aircraft.cruise / ((task.round ? 1 : 2) * task.length);
  }
  double operator()(const RouteTask& task) const {
    const double distance = (aircraft.place - place).norm() + task.length;
    const double time =
        aircraft.cruise > 0 ? distance / aircraft.cruise : math::kInfinity;
    const double reserve = std::min(kMaxReserve, aircraft.endurance / (kReserve * time));
    return reserve >= 1 ? reserve : 0;
  }
  double operator()(const GuardTask& task) const {
    return task.sensor.empty() || sensor_of(aircraft, task.sensor) ? 1 / task.wanted : 0;
  }
  double operator()(const RelayTask& task) const {
    // It flies between both ends: each leg is half of what parts them.
    const double leg = (task.to - task.from).norm() / 2;
    return leg <= kRelayRange * task.range ? aircraft.relay_quality : 0;
  }
  double operator()(const ShareTask& task) const { return task.shares[index]; }
};

struct FormOf {
  Satisfaction operator()(const SurveillanceTask&) const { return Satisfaction::kRoot; }
  Satisfaction operator()(const TrackingTask&) const { return Satisfaction::kBest; }
  Satisfaction operator()(const PatrolTask&) const { return Satisfaction::kRoot; }
  Satisfaction operator()(const RouteTask&) const { return Satisfaction::kBest; }
  Satisfaction operator()(const GuardTask&) const { return Satisfaction::kRoot; }
  Satisfaction operator()(const RelayTask&) const { return Satisfaction::kBest; }
  Satisfaction operator()(const ShareTask&) const { return Satisfaction::kShare; }
};

}  // namespace

CoalitionTask satisfaction_row(const TeamTask& task, const Aircraft& aircraft) {
  CoalitionTask row;
  row.form = std::visit(FormOf{}, task.what);
  for (std::size_t i = 0; i < aircraft.size(); ++i)
    row.brings.push_back(std::visit(Brings{aircraft[i], i, task.place}, task.what));
  row.cost.assign(aircraft.size(), 0);
  return row;
}

CoalitionProblem coalition_problem(const Aircraft& aircraft,
                                   const std::vector<TeamTask>& tasks, double delta,
                                   bool idle_allowed) {
  const auto distance = [&](const TeamAircraft& a, const TeamTask& t) {
    return (a.place - t.place).norm();
  };
  double longest = 0;
  for (const TeamAircraft& a : aircraft)
    for (const TeamTask& t : tasks) longest = std::max(longest, distance(a, t));
  if (!(delta > 0)) delta = longest > 0 ? 1 / (1.001 * longest) : 0;
  CoalitionProblem problem;
  problem.aircraft = aircraft.size();
  problem.idle_allowed = idle_allowed;
  for (const TeamTask& t : tasks) {
    CoalitionTask row = satisfaction_row(t, aircraft);
    for (std::size_t i = 0; i < aircraft.size(); ++i)
      row.cost[i] = delta * distance(aircraft[i], t);
    problem.tasks.push_back(std::move(row));
  }
  return problem;
}

}  // namespace skein::solve
