// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/geo/rotation.h"
#include "skein/layer/reasoning/avoidance/group/joint_search.h"

namespace skein::reasoning {

/// Straight flights of 20 m/s through one place, from all sides, at which all are 60 s
/// after the start.
inline std::vector<FlightPlan> circle_of_flights(int count) {
  std::vector<FlightPlan> plans;
  for (int k = 0; k < count; ++k) {
    FlightElement straight;
    straight.airspeed = 20;
    straight.duration = 120;
    straight.heading = 2 * geo::kPi * k / count + 0.05;
    straight.p_N.head<2>() = -1200 * geo::unit(straight.heading);
    straight.p_N.z() = -150;
    plans.push_back({straight});
  }
  return plans;
}

/// The problem that they have, where all of them take part.
inline JointProblem joint_problem(const std::vector<FlightPlan>& plans) {
  JointProblem problem;
  for (const FlightPlan& plan : plans) problem.members.push_back({{plan, 120, {}}, {}});
  problem.kept.assign(plans.size() * plans.size(), {50, 20});
  problem.begin = 5;
  problem.look_until = 300;
  return problem;
}

}  // namespace skein::reasoning
