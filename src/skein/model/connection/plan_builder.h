// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/connection/connection.h"

namespace skein::model {

/// Puts elements one behind the other: level, through one air, from a pose on.
class PlanBuilder {
 public:
  /// @param start  time [s].
  /// @param down   p_N.z() of the whole flight [m].
  PlanBuilder(const Pose& from, const AirMotion& air, double start = 0, double down = 0);

  /// Flies `length` turn radii of air to one side: +1 right, -1 left, 0 straight. Nothing
  /// is added for lengths that are not above 0.
  void fly(double length, double side);

  FlightPlan take() { return std::move(plan_); }

 private:
  AirMotion air_;
  FlightElement next_;
  FlightPlan plan_;
};

}  // namespace skein::model
