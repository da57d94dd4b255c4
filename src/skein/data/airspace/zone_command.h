// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "skein/base/result.h"
#include "skein/data/airspace/zone_change.h"

namespace skein {

/// An operator's line about a no-fly zone, as a change without number:
///
///   zone on NAME circle NORTH,EAST RADIUS [LIMITS]
///   zone on NAME ring NORTH,EAST NORTH,EAST NORTH,EAST ... [LIMITS]
///   zone on NAME                  a zone that the scenario or an earlier line has drawn
///   zone off NAME
///
/// LIMITS: `floor M`, `ceiling M` (above mean sea level), `from S`, `until S`, in any
/// order. Metres in the local frame, seconds of the run; words are parted by blanks, so
/// that names have none.
///
/// Fails: kBadInput when the line is none of these, or when error_in() rejects the zone
///        that it draws.
Result<ZoneChange> parse_zone_command(std::string_view line);

}  // namespace skein
