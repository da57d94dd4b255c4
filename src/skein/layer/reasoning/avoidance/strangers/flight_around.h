#pragma once

#include <optional>
#include <vector>

#include "skein/layer/reasoning/avoidance/strangers/stranger_view.h"

namespace skein::reasoning {

/// Where each stranger comes near the plan; of those that do not, where one might come on
/// the way around another.
std::vector<PredictedIntersection> meetings_with(const StrangerView& view);

/// The cheapest of some flights that stays clear of all strangers, as they are expected
/// to go on, and of planned flights, zones and ground: another course for some time to
/// either side, higher, lower, faster or slower. At first all of the way is looked at,
/// then the next minute only.
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
