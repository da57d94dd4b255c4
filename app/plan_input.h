#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/plan_arguments.h"
#include "base/result.h"
#include "geo/local_frame.h"
#include "model/connection/connection.h"
#include "role/path_planner.h"

namespace skein::app {

/// The numbers of an option, parted by commas.
/// Fails: kBadInput unless there are `least` to `most`, all finite; the message names the
///        option and `form`, what is allowed.
Result<std::vector<double>> numbers_of(const std::string& option, const std::string& text,
                                       std::size_t least, std::size_t most,
                                       const std::string& form);

/// Where a plan is and in which air, as options say.
struct ReadSetting {
  std::optional<geo::LocalFrame> frame;  ///< none: only metres are known
  model::AirMotion air;
  std::optional<double> altitude;  ///< [m]
};

/// Reads the setting. The origin is that of --origin, else `elsewhere` if there is one.
/// Fails: kBadInput for what is missing, not a number or not allowed; wind at or above
/// the
///        airspeed.
Result<ReadSetting> read_setting(const PlanSetting& given,
                                 const std::optional<geo::Geodetic>& elsewhere);

/// The two ends of a flight in the local frame, headings of the air-relative velocity.
struct ReadEnds {
  FlightState from, to;
  bool has_altitude = false;  ///< given with the ends or for the plan
};

/// The place of --from-geo, where the origin is unless --origin says otherwise.
Result<std::optional<geo::Geodetic>> place_of(const PlanEnds& given);

/// Fails: kBadInput for ends that are missing, given twice or no numbers, far from the
///        origin, or with a course that no heading gives.
Result<ReadEnds> read_ends(const PlanEnds& given, const ReadSetting& setting);

}  // namespace skein::app
