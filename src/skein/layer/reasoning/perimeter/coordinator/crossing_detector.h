// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "skein/data/perimeter/fire.h"

namespace skein::perimeter {

/// What is known of a reading and the one of its aircraft that was heard before.
enum class Follows : std::uint8_t {
  kByTime,    ///< directly, unless their times tell that others were lost
  kDirectly,  ///< nothing was read between them
  kPerhaps,   ///< others may not have been sent
  kNothing,   ///< it is of a place passed at some time before
};

/// A reading as it is heard.
struct HeardReading {
  FireReading reading;
  Follows follows = Follows::kByTime;
};

/// Finds the moments when an aircraft passed the boundary: two successive readings that
/// differ.
class CrossingDetector {
 public:
  /// @param longest_gap  Readings further apart in time than this make no crossing [s]:
  /// those between them were lost, or not sent. A sensor that is slower (up to one
  /// reading in 30 s) is allowed one and a half of its own periods.
  explicit CrossingDetector(double longest_gap = 3) : longest_gap_(longest_gap) {}

  /// Takes the next reading of an aircraft (times do not go back for one aircraft) and
  /// gives the crossing that it completes, if any.
  std::optional<Crossing> take(const HeardReading& heard);

 private:
  double longest_gap_;
  struct Last {
    FireReading reading;
    double min_interval = 0;  // between two readings; 0 = only one so far [s]
  };
  std::map<EntityId, Last> last_;
};

}  // namespace skein::perimeter
