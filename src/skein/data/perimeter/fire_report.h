// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/perimeter/fire.h"

namespace skein {

/// A place, to the decimetre.
struct BriefPlace {
  std::int32_t north_dm = 0, east_dm = 0;
};

constexpr auto describe(const BriefPlace*) {
  using T = BriefPlace;
  return described<T>({"brief_place"}, "A place, to the decimetre.",
                      field("north_dm", &T::north_dm, "decimetres north"),
                      field("east_dm", &T::east_dm, "decimetres east"));
}

/// A reading of a fire sensor among others of the same.
struct BriefReading {
  std::uint32_t before_ms = 0;  ///< by so much it is older than the last [ms]
  BriefPlace place;
  bool inside = false;
  bool adjacent = false;  ///< to the one before it: nothing was read between them
};

constexpr auto describe(const BriefReading*) {
  using T = BriefReading;
  return described<T>(
      {"brief_reading"}, "A reading of a fire sensor among others of the same.",
      field("before_ms", &T::before_ms,
            "milliseconds by which it is older than the last"),
      field("place", &T::place, "the point looked at"),
      field("inside", &T::inside, "it burns"),
      field("adjacent", &T::adjacent, "nothing was read between it and the one before"));
}

/// What an aircraft has seen of a fire, where the air has no room for all its readings.
struct FireReport {
  Time time;                                ///< of the last reading
  float position_sd = 0;                    ///< of all places, per axis [m]
  std::vector<BriefReading> readings = {};  ///< in order of time
  std::vector<BriefPlace> burning = {};     ///< between them and the report before
};

constexpr auto describe(const FireReport*) {
  using T = FireReport;
  return described<T>(
      {"readings"}, "What an aircraft has seen of a fire since it said so last.",
      field("time", &T::time, "of the last reading"),
      field("position_sd", &T::position_sd, "metres, of all places, per axis"),
      field("readings", &T::readings, Storage::kJson, "in order of time"),
      field("burning", &T::burning, Storage::kJson, "where it burns too, seen before"));
}

/// A place as it is sent; a hundred thousand kilometres off at most.
BriefPlace brief(const Vec2& place);

/// A reading as it is sent with others, the last of which is of `last`.
BriefReading brief(const FireReading& reading, Time last, bool adjacent);

/// What `aircraft` says of one of its readings.
FireReading reading_of(const FireReport& report, const BriefReading& reading,
                       EntityId aircraft);

/// What it says of a place where it burns.
FireReading reading_of(const FireReport& report, const BriefPlace& burning,
                       EntityId aircraft);

}  // namespace skein
