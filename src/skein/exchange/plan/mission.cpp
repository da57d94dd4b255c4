// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/mission.h"

#include <fmt/format.h>

#include "skein/exchange/plan/samples.h"
#include "skein/exchange/table/formats.h"

namespace skein::exchange {
namespace {

constexpr int kGlobal = 0, kNoPlace = 2;           // MAV_FRAME
constexpr int kWaypoint = 16, kChangeSpeed = 178;  // MAV_CMD

}  // namespace

Result<std::vector<MissionItem>> to_mission(const Document& document,
                                            const WritingOptions& options) {
  if (auto good = check_known(Format::kWaypoints, known_of(document)); !good)
    return good.error();
  if (document.plans.size() == 1 && document.plans[0].plan.empty())
    return Error{ErrorCode::kBadInput, "",
                 "the flight is empty; a mission needs waypoints.",
                 "Write another format."};
  const FlightPlan& plan = document.plans[0].plan;
  std::vector<MissionItem> items;
  double airspeed = 0;
  for (const FlightSample& each : samples(plan, options.tolerance)) {
    const FlightElement& e = plan[each.element];
    if (e.airspeed != airspeed) {
      airspeed = e.airspeed;
      // Airspeed (0), its value, throttle as it is (-1).
      items.push_back({kNoPlace, kChangeSpeed, {0, airspeed, -1, 0}});
    }
    const Vec3& p = each.moment.p_N;
    const geo::Geodetic at = document.frame->from_plane(p.head<2>());
    items.push_back({kGlobal,
                     kWaypoint,
                     {0, 0, 0, 0},
                     at.latitude_deg,
                     at.longitude_deg,
                     0.0 - p.z()});
  }
  return items;
}

}  // namespace skein::exchange
