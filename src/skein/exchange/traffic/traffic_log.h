// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"

namespace skein::exchange {

/// One place of a recorded flight.
struct LoggedPlace {
  double time = 0;  ///< since the start of the run [s]
  Vec3 p_N = Vec3::Zero();
};

/// What an altitude is measured from.
enum class AltitudeDatum {
  kSeaLevel,    ///< `altitude_msl_m`, `altitude_ft`
  kGeometric,   ///< `geoaltitude`, by satellites
  kBarometric,  ///< `baroaltitude`, by the pressure, of a standard atmosphere
};
inline constexpr std::size_t kAltitudeData = 3;

/// What one aircraft of a log flew.
struct LoggedFlight {
  std::string id;                   ///< as the log has it; empty: it has no such column
  std::vector<LoggedPlace> places;  ///< in order of time, one at least
  AltitudeDatum datum = AltitudeDatum::kSeaLevel;  ///< of all its places
};

struct TrafficLog {
  std::vector<LoggedFlight> flights;  ///< in order of their first rows, one at least
  std::size_t rows = 0;
  std::size_t left_out =
      0;  ///< rows without a position, or for an aircraft on the ground
  std::size_t repeated = 0;     ///< rows that repeat an old position
  std::size_t barometric = 0;   ///< rows flown by a barometric altitude; see below
  std::size_t other_datum = 0;  ///< rows without the altitude of their aircraft's datum
  std::size_t far = 0;          ///< rows over 1000 km from the origin
  double farthest = 0;          ///< of them [m]
  std::vector<std::string> ignored;  ///< columns that mean nothing here
};

/// How a log is placed in a run.
struct LogPlacement {
  const geo::LocalFrame& frame;
  double start_unix = 0;  ///< when the run starts, since 1970 [s]
};

/// Reads recorded flights: comma separated, the first line names the columns, in any
/// order.
///
/// | columns | |
/// |---|---|
/// | `time_s` | since the start of the run; or `unix_s`, or `time` as OpenSky has it:
/// since 1970 | | `north_m`, `east_m` | in the local frame; or `latitude_deg`,
/// `longitude_deg`; or `lat`, `lon` | | `altitude_msl_m` | or `altitude_ft`; or
/// `geoaltitude` [m], `baroaltitude` [m] | | `id` |
/// which aircraft; or `icao24`; without it all rows are of one | | `velocity_north_mps`,
/// `velocity_east_mps`, `climb_mps`, `ground_speed_mps`, `track_deg`; of OpenSky
/// `velocity`, `heading`, `vertrate`, `callsign`, `onground`, `alert`, `spi`, `squawk`,
/// `lastposupdate`, `lastcontact`, `hour`, `serials` | allowed |
///
/// Of the last `onground` is looked at, and what shows that a position is old: a row at
/// the very place of the one before of its aircraft whose `lastposupdate` (or
/// `time_position`) has not changed, or, without that column, whose `velocity` is above 2
/// m/s; it repeats the last position and is left out. Other columns are ignored and
/// listed, but not those that look like a time, a place or an altitude in another unit.
///
/// An aircraft flies by altitudes of one datum: the first of those above that at least
/// half of its rows have, else the one that most have. Rows without it are left out, so
/// that it does not jump by what two differ, often a hundred metres.
///
/// Blank lines are no rows. Rows of several aircraft may be mixed; those of one come in
/// order of time. A row with an empty position or altitude (also `NULL`, `nan`, `None`)
/// is left out, one whose `onground` is true, and one over 1000 km from the origin; the
/// same place said twice is said once.
///
/// Fails: kBadInput with line and column for a header without what is needed, with a
///        column twice or in an unknown unit; for rows with too few or too many cells,
///        cells that are no finite number or out of range, and times of an aircraft that
///        do not grow; for a log without a place, or without one within 1000 km.
Result<TrafficLog> parse_traffic_log(std::string_view text, const std::string& name,
                                     const LogPlacement& placement);

/// As above, from a file.
/// Fails: also kNotFound, and kBadInput above 200 MB.
Result<TrafficLog> read_traffic_log(const std::filesystem::path& file,
                                    const LogPlacement& placement);

}  // namespace skein::exchange
