// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/model/well_clear/alerting.h"

namespace skein::exchange {

/// An aircraft among others at one moment.
struct Encounter {
  std::string name;
  model::AircraftMotion own;
  std::vector<model::Intruder> intruders;
  std::vector<int> numbers;  ///< of the intruders, as the table has them
};

/// Reads a table of encounters.
///
/// Comma separated with a header line: case, aircraft (0: the own one), alerter (a name
/// of the configuration; not looked at of the own aircraft), north_m, east_m, down_m,
/// vn_mps, ve_mps, vd_mps, in any order; other columns are ignored, blank lines are no
/// rows. The rows of a case stand together; it has one own aircraft, and each intruder
/// has a number of its own.
///
/// @param place  name of the file, for messages.
/// Fails: kBadInput with the line and what is allowed; positions are within 1e7 m and
///        speeds below 1e4 m/s.
Result<std::vector<Encounter>> read_encounters(
    std::string_view text, const std::string& place,
    const model::WellClearConfiguration& configuration);

}  // namespace skein::exchange
