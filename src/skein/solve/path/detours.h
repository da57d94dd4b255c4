// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/solve/path/tangent_graph.h"

namespace skein::solve {

/// How far routes stay from zones, so that rounding is no conflict.
struct DetourMargins {
  double disc = 0;    ///< [m]
  double corner = 0;  ///< [m], above 0
};

/// Routes around zones, of which only those are looked at that block the route: the graph
/// is searched among few zones, the zones that its routes meet are added, until they meet
/// no more. What is quickest among fewer zones and free among all is quickest among all.
///
/// @param zones   which may block the route at the altitudes and times of the request.
/// @param query   for the area and the ground; its airspace is not used.
/// Cost: of k zones that matter at most k searches among k zones, besides one look at the
///       map of all zones per piece of each route.
Detours detours_around(const std::vector<Zone>& zones, const PathQuery& query,
                       const GroundSpeed& speed, const DetourRequest& request,
                       const DetourMargins& margins, const PlanningBudget& budget);

/// A route as flown without wind: straights and turns at constant altitude rate.
/// Valid: no wind; arcs no tighter than the aircraft can fly.
FlightPlan fly_detour(const Detour& detour, const PathQuery& query);

}  // namespace skein::solve
