// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/connection/connection.h"
#include "skein/solve/target/moving_target.h"

namespace skein::solve {

/// Where an aircraft shall be at a time, with which heading.
using MovingPose = std::function<model::Pose(double time)>;

/// The quickest flight to a pose that moves, level at `down`; empty when none is found.
///
/// For a target that moves evenly as long as the path takes this is the exact connection
/// in its frame, where the wind is w - v_target; else the time of arrival is a fixed
/// point of "fly to where it will be then", and without one the first of times one second
/// apart that can be met exactly by a detour (model/connection/arrival.h).
/// @param pose  moves with the target.
/// Needs |wind| and the wind felt by the target below the airspeed.
FlightPlan connection_to(const MovingPose& pose, const MovingTarget& target,
                         const model::Pose& from, const model::AirMotion& air,
                         double start, double down);

/// The first of the times from `earliest` to `latest`, one second apart, at which the
/// pose can be met exactly by a flight that begins at `start`
/// (model/connection/arrival.h); empty when none can.
FlightPlan meeting(const MovingPose& pose, const model::Pose& from,
                   const model::AirMotion& air, double start, double earliest,
                   double latest, double down);

}  // namespace skein::solve
