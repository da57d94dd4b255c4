// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/result.h"
#include "skein/exchange/table/document.h"
#include "skein/exchange/table/writers.h"

namespace skein::exchange {

/// One item of a MAVLink mission (MISSION_ITEM_INT without what a file does not hold).
struct MissionItem {
  int frame = 0;    ///< MAV_FRAME: 0 global, altitude above mean sea level; 2 no place
  int command = 0;  ///< MAV_CMD: 16 waypoint, 178 change of speed
  double params[4] = {0, 0, 0, 0};
  double latitude_deg = 0, longitude_deg = 0, altitude_m = 0;
};

/// The mission that makes an autopilot with straight legs fly a document's plan: its
/// airspeed whenever that changes, and waypoints so close that the legs leave the plan by
/// at most the tolerance. The first waypoint is the plan's start.
///
/// Fails: kBadInput without a frame, without altitudes, with no plan or several.
Result<std::vector<MissionItem>> to_mission(const Document& document,
                                            const WritingOptions& options);

}  // namespace skein::exchange
