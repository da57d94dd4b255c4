// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"
#include "skein/layer/reasoning/trajectory/zone_monitor.h"

namespace skein::reasoning {

/// A path from where the aircraft is to a point of its legs, around the zones that count,
/// as last regarded, and above the ground.
/// @param context  has a planner.
/// @param course   over ground, at the point [rad].
PlannedPath plan_leg(const Legs& legs, const FlightContext& context, const AgentInput& in,
                     const ZoneMonitor& zones, const Vec2& goal, double course);

}  // namespace skein::reasoning
