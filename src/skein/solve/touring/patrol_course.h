// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/connection/connection.h"
#include "skein/solve/touring/patrol.h"

namespace skein::solve {

/// A straight part of a patrol, as far as it is flown straight.
struct PatrolLeg {
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();  ///< ends of the line [m]
  double late = 0;   ///< straight flight begins this far after a [m]
  double early = 0;  ///< and ends this far before b [m]
};

/// One round of a patrol: legs in order; behind each one the path to the next, behind the
/// last one to the first.
struct PatrolCourse {
  std::vector<PatrolLeg> legs;
  std::vector<model::Connection>
      turns;             ///< from the end of leg k to the begin of the next
  int legs_of_pass = 0;  ///< 2 passes make a round there and back
  double deviation = 0;  ///< largest, at corners that are rounded [m]
  int flown_over = 0;    ///< corners that could not be rounded
};

/// Lines moved by the offset, corners rounded or not; there and back, or around.
/// Needs |wind| < airspeed and a valid line.
PatrolCourse course_of(const PatrolQuery& query, const std::vector<Vec2>& line,
                       double offset, const model::AirMotion& air);

/// The pose in which a round begins.
model::Pose begin_of(const PatrolCourse& course, const model::AirMotion& air);

/// Flight along a number of passes from the begin of the course, level at `down`.
FlightPlan along(const PatrolCourse& course, int passes, const model::AirMotion& air,
                 double start, double down);

}  // namespace skein::solve
