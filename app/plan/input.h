// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/plan/arguments.h"
#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/model/connection/connection.h"
#include "skein/role/path_planner.h"

namespace skein::app {

/// The numbers of an option, parted by commas.
/// Fails: kBadInput unless there are `min` to `max`, all finite; the message names the
///        option and `form`, what is allowed.
Result<std::vector<double>> numbers_of(const std::string& option, const std::string& text,
                                       std::size_t min, std::size_t max,
                                       const std::string& form);

/// Where a plan is and in which air, as options say.
struct ReadSetting {
  std::optional<geo::LocalFrame> frame;  ///< none: only metres are known
  model::AirMotion air;
  std::optional<double> altitude;  ///< [m]
};

/// Reads the setting. The origin is that of --origin, else `elsewhere` if there is one.
/// Fails: kBadInput for what is missing, not a number or not allowed; wind at or above
///        the airspeed.
Result<ReadSetting> read_setting(const PlanSetting& given,
                                 const std::optional<geo::Geodetic>& elsewhere);

/// A flight state and whether its altitude was given.
struct ReadState {
  FlightState state;
  bool has_altitude = false;
};

/// One end of a flight, from the text of `--name` or of `--name-geo`.
/// Fails: kBadInput for one that is missing, given twice, no numbers, or far from the
///        origin.
Result<ReadState> read_state(const std::string& name, const std::string& local,
                             const std::string& geographic, const ReadSetting& setting);

/// The ends of several flights, from the texts of `--name` or of `--name-geo`.
Result<std::vector<ReadState>> read_states(const std::string& name,
                                           const std::vector<std::string>& local,
                                           const std::vector<std::string>& geographic,
                                           const ReadSetting& setting);

/// A point, from the text of `--name` (NORTH,EAST) or of `--name-geo` (LAT,LON).
Result<Vec2> read_point(const std::string& name, const std::string& local,
                        const std::string& geographic, const ReadSetting& setting);

/// The limits that planners take.
/// Fails: kBadInput unless slowest <= airspeed <= fastest.
Result<FlightLimits> limits_of(const PlanLimits& given, const ReadSetting& setting);

/// The two ends of a flight in the local frame, headings of the air-relative velocity.
struct ReadEnds {
  FlightState from, to;
  bool has_altitude = false;  ///< given with the ends or for the plan
};

/// The place of --from-geo, where the origin is unless --origin says otherwise; none for
/// an empty text.
Result<std::optional<geo::Geodetic>> place_of(const std::string& from_geo);

/// Fails: kBadInput for ends that are missing, given twice or no numbers, far from the
///        origin, or with a course that no heading gives.
Result<ReadEnds> read_ends(const PlanEnds& given, const ReadSetting& setting);

}  // namespace skein::app
