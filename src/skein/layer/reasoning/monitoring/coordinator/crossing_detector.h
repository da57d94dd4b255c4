#pragma once

#include <map>
#include <optional>

#include "skein/data/fire.h"

namespace skein::monitoring {

/// Finds the moments when an aircraft passed the boundary: two successive readings that
/// differ.
class CrossingDetector {
 public:
  /// @param longest_gap  Readings further apart in time than this make no crossing [s]:
  /// those between them were lost. A sensor that is slower (up to one reading in 30 s) is
  /// allowed one and a half of its own periods.
  explicit CrossingDetector(double longest_gap = 3) : longest_gap_(longest_gap) {}

  /// Takes the next reading of an aircraft (times do not go back for one aircraft) and
  /// gives the crossing that it completes, if any.
  std::optional<Crossing> take(const FireReading& reading);

 private:
  double longest_gap_;
  struct Last {
    FireReading reading;
    double min_interval = 0;  // between two readings; 0 = only one so far [s]
  };
  std::map<EntityId, Last> last_;
};

}  // namespace skein::monitoring
