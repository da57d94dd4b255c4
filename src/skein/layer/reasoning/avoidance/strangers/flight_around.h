// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/layer/reasoning/avoidance/strangers/stranger_view.h"

namespace skein::reasoning {

/// Where a stranger comes near the plan, or might come on the way around another.
struct StrangerMeeting {
  PredictedIntersection where;
  bool of_plan = true;  ///< the plan itself is met
};
/// One for each stranger, in their order.
std::vector<StrangerMeeting> meetings_with(const StrangerView& view);

/// The no-fly zones and, where rooms are static, those of the strangers that the plan
/// meets. Of the others only those rooms are kept that move.
std::vector<Zone> zones_with_rooms(const StrangerView& view,
                                   std::span<const StrangerMeeting> meetings);

/// Whether the room of a stranger is one that moves.
bool moves(const StrangerView& view, const StrangerMeeting& meeting);

/// The cheapest of some flights that stays clear of all strangers, as they are expected
/// to go on, and of planned flights, zones and ground: another course for some time to
/// either side, higher, lower, faster or slower. At first all of the way is looked at,
/// then the next minute only. Where rooms are static, of the strangers that the plan
/// meets these rooms are kept clear.
///
/// @param first  the intersection that is to be solved.
/// @param begin  the plan may be left from then on [s].
/// @returns  from `begin` to the end of the plan; none where no such flight is clear.
/// Cost: some hundred flights are compared with those of all others.
std::optional<FlightPlan> flight_around(const StrangerView& view,
                                        const PredictedIntersection& first, double begin);

/// The quickest way on to where the plan is met again, if that is clear and saves two
/// seconds: strangers have passed, or do not come.
std::optional<FlightPlan> flight_straight_on(const StrangerView& view, double begin);

}  // namespace skein::reasoning
