// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/vehicle/flight_plan.h"
#include "skein/geo/local_frame.h"

namespace skein::exchange {

/// One aircraft of a fleet: what it is to fly, and when it may start.
struct FleetRow {
  std::string name;  ///< not empty, no other row has it
  FlightState start, goal;
  double earliest_start = 0, latest_start = 0;  ///< [s]
};

/// What holds where a row says nothing.
struct FleetDefaults {
  const geo::LocalFrame* frame = nullptr;  ///< none: places are in metres only
  std::optional<double> altitude;          ///< above mean sea level [m]
  double earliest_start = 0;               ///< [s]
  std::optional<double> latest_start;      ///< [s]; none: the earliest
};

/// The aircraft in the order of the rows.
struct FleetTable {
  std::vector<FleetRow> rows;
  bool has_altitude = false;  ///< of all places; otherwise none has one
};

/// Reads the table of a fleet: comma separated, with a header line, columns in any order.
///
/// Columns: name; for `start` and `goal` each start_north_m and start_east_m or
/// start_latitude_deg and start_longitude_deg, start_altitude_m and start_heading_deg, of
/// the nose clockwise from north; earliest_start_s, latest_start_s. Others are ignored.
/// Altitudes and times may be missing, as columns and as single cells: then the defaults
/// hold.
///
/// @param text   any bytes.
/// @param place  name of the file, for messages.
/// Fails: kBadInput with the line and the column: a cell is no number in its range, a
///        place is missing, given twice or farther than 1000 km from the origin,
///        latitudes without a frame, an altitude of only some places, a name that is
///        missing or there twice, a latest start before the earliest or more than a day
///        after it; no row, or more than 10,000.
Result<FleetTable> read_fleet_table(std::string_view text, const std::string& place,
                                    const FleetDefaults& defaults);

}  // namespace skein::exchange
