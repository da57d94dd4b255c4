// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/layer/reasoning/avoidance/intruders/intruder_view.h"

namespace skein::reasoning {

/// Where an intruder comes near the plan, or might come on the way around another.
struct IntruderEncounter {
  PredictedIntersection where;
  bool of_plan = true;  ///< the plan itself is met
};
/// One for each intruder, in their order.
std::vector<IntruderEncounter> encounters_with(const IntruderView& view);

/// The no-fly zones and, where rooms are static, those of the intruders that the plan
/// meets. Of the others only those rooms are kept that move.
std::vector<Zone> zones_with_rooms(const IntruderView& view,
                                   std::span<const IntruderEncounter> encounters);

/// Whether the room of an intruder is one that moves.
bool moves(const IntruderView& view, const IntruderEncounter& encounter);

/// The cheapest of some flights that stays clear of all intruders, as they are expected
/// to go on, and of planned flights, zones and ground: another course for some time to
/// either side, higher, lower, faster or slower. At first all of the way is looked at,
/// then the next minute only. Where rooms are static, of the intruders that the plan
/// meets these rooms are kept clear.
///
/// @param first  the intersection that is to be solved.
/// @param begin  the plan may be left from then on [s].
/// @returns  from `begin` to the end of the plan; none where no such flight is clear.
/// Cost: some hundred flights are compared with those of all others.
std::optional<FlightPlan> flight_around(const IntruderView& view,
                                        const PredictedIntersection& first, double begin);

/// The quickest way on to where the plan is met again, if that is clear and saves two
/// seconds: intruders have passed, or do not come.
std::optional<FlightPlan> flight_straight_on(const IntruderView& view, double begin);

}  // namespace skein::reasoning
