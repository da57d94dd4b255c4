// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/flight_plan.h"

namespace skein::reasoning {

/// The flight straight on with a velocity over ground, climbing or sinking with it for
/// some time and level then: what an aircraft flies that has no plan.
///
/// @param p_N, v_N   at its start [m], over ground [m/s].
/// @param start      on the run's clock [s].
/// @param duration   of it all [s].
/// @param climb_for  how long the climb rate of `v_N` lasts, up to `duration` [s].
FlightPlan course_flight(const Vec3& p_N, const Vec3& v_N, double start, double duration,
                         double climb_for);

}  // namespace skein::reasoning
