// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/data/vehicle/vehicle_request.h"
#include "skein/geo/local_frame.h"
#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/messages.h"

// Lists that ground stations load up, as the simulation has them.

namespace skein::vehicle_services {

/// What became of a list.
struct ListVerdict {
  mavlink::MissionResult result = mavlink::MissionResult::kAccepted;
  std::string reason;  ///< for people; empty when it is accepted
  bool ok() const { return result == mavlink::MissionResult::kAccepted; }
};

/// What the items of a mission are read with.
struct MissionContext {
  const geo::LocalFrame* frame = nullptr;
  Vec3 home_N = Vec3::Zero();
  FlightLimits limits;
  bool hovers = false;
  double loiter_radius = 0;  ///< [m]
  std::size_t first = 0;     ///< number that ground stations give to the first item
};

/// A mission, item by item: item k here is item k there.
///
/// Altitudes above home count from home as it is now. An item without a place is where
/// the one before is, the first at home. Circles to be flown so many times become a hold
/// of as long; only fixed wings fly circles. Repeats without end become 65535.
/// Refused: frames without an altitude above sea level or home, commands that are no part
/// of missions here, places that are none, speeds that the vehicle does not fly, jumps to
/// nowhere. The reason names the item as ground stations number it.
ListVerdict read_mission(const std::vector<mavlink::MissionItemInt>& list,
                         const MissionContext& context, std::vector<MissionItem>& items);

/// A fence: corners of polygons, each with the number of its polygon's corners, and
/// circles. A return point is accepted, and has no effect.
ListVerdict read_fence(const std::vector<mavlink::MissionItemInt>& list,
                       const geo::LocalFrame& frame, std::vector<Zone>& inclusion,
                       std::vector<Zone>& exclusion);

/// Rally points: whether they are points.
ListVerdict check_rally_points(const std::vector<mavlink::MissionItemInt>& list,
                               const geo::LocalFrame& frame);

}  // namespace skein::vehicle_services
