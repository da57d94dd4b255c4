// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/connection/connection.h"
#include "skein/solve/target/moving_target.h"

namespace skein::solve {

/// The path to a target and S-turns along its track, until `duration` after the first
/// meeting; see OrbitKind::kWeave. Level at `down`.
/// @param entry  set to the time of the first meeting [s].
/// @returns      empty when the target cannot be met.
FlightPlan weave_along(const MovingTarget& target, const model::Pose& from,
                       const model::AirMotion& air, double start, double duration,
                       double down, double& entry);

}  // namespace skein::solve
