// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/data/describe/describe.h"

namespace skein {

/// Where a vehicle is in its stored mission.
struct MissionProgress {
  std::uint16_t current = 0;  ///< flown now
  bool finished = false;

  bool operator==(const MissionProgress&) const = default;
};

constexpr auto describe(const MissionProgress*) {
  using T = MissionProgress;
  return described<T>({"mission_progress"}, "Where a vehicle is in its stored mission.",
                      field("current", &T::current, "item flown now"),
                      field("finished", &T::finished, "the last one is done"));
}

}  // namespace skein
