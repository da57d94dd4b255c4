// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "skein/geo/vec.h"
#include "skein/solve/allocation/coalitions.h"

namespace skein::solve {

/// A sensor as allocation sees it.
struct TeamSensor {
  double swath = 0;    ///< width that one pass covers [m]
  double quality = 0;  ///< 0 to 1
};

/// An aircraft as allocation sees it.
struct TeamAircraft {
  Vec2 place = Vec2::Zero();                  ///< N [m]
  double v_min = 0, v_max = 0, cruise = 0;    ///< airspeeds [m/s]
  double turn_radius = 0;                     ///< [m]
  double endurance = 0;                       ///< that is left [s]
  std::map<std::string, TeamSensor> sensors;  ///< by kind
  double relay_quality = 0;                   ///< 0 to 1; 0: it has no relay
};

/// An area that is surveyed once.
struct SurveillanceTask {
  std::string sensor;
  double area = 0;  ///< [m^2], above 0
};
/// An object that is followed; radius of turn counts.
struct TrackingTask {
  std::string sensor;
  double speed = 0;  ///< of the object [m/s]
};
/// A line that is flown along again and again, there and back or round.
struct PatrolTask {
  double length = 0;   ///< [m], above 0
  double revisit = 0;  ///< wanted time between two looks at a place [s]
  bool round = false;
};
/// Points or a line that one aircraft flies once.
struct RouteTask {
  double length = 0;  ///< of the flight within the task [m]
};
/// A task that wants so many able aircraft: protect, cordon, escort.
struct GuardTask {
  std::string sensor;  ///< empty: any aircraft is able
  double wanted = 1;   ///< aircraft, above 0
};
/// A link by way of an aircraft.
struct RelayTask {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< N [m]
  double range = 0;                             ///< of the radio [m]
};
/// A task that says itself what share of its value each aircraft would reach: measure a
/// field, the perimeter of a fire.
struct ShareTask {
  std::vector<double> shares;  ///< by aircraft, 0 to 1
};

/// A task as allocation sees it.
struct TeamTask {
  Vec2 place = Vec2::Zero();  ///< what distances are measured to, N [m]
  std::variant<SurveillanceTask, TrackingTask, PatrolTask, RouteTask, GuardTask,
               RelayTask, ShareTask>
      what;
};

/// How well one aircraft or a group of them satisfies a task, as the row of a coalition
/// problem without costs.
///
///   surveillance  x = sqrt(sum A / area), A = 0.8 swath cruise endurance; x from 1 on
///   tracking      best of 2 q f_v / (1 + rho / 100 m); f_v = 1 if v_min <= v, else
///                 exp(-(v_min - v) / 10 m/s); 0 if v_max < v
///   patrol        y = sqrt(revisit sum cruise / (2 L)), L in place of 2 L round
///   route         best of min(1.5, endurance / (1.2 time needed)), 0 below 1
///   guard         y = sqrt(able / wanted)
///   relay         best of q where both legs are within 0.8 range
///   share         sum of shares, at most 1
///
/// Reference: spec of the team, section 11.
CoalitionTask satisfaction_row(const TeamTask& task,
                               const std::vector<TeamAircraft>& aircraft);

/// The problem with straight distances: joining costs `delta` for each metre to the task.
///
/// @param delta  [1/m]; 0: 1 / (1.001 times the longest distance), so that each is
///               below 1.
CoalitionProblem coalition_problem(const std::vector<TeamAircraft>& aircraft,
                                   const std::vector<TeamTask>& tasks, double delta,
                                   bool idle_allowed);

}  // namespace skein::solve
