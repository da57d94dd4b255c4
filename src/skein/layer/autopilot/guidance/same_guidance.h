// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/autopilot.h"

namespace skein::autopilot {

/// Does `next` ask for the same path, plan, waypoints, take-off or landing as `now`?
/// Then what has begun goes on; altitude and airspeed may differ. (Courses, circles and
/// places to hold have no progress that could be lost: never the same.)
bool same_guidance(const AutopilotCommand& now, const AutopilotCommand& next);

/// Does the guidance come with altitudes of its own?
bool has_own_altitude(const AutopilotCommand& command);

}  // namespace skein::autopilot
