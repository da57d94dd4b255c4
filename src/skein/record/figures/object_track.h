// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "skein/data/perimeter/object.h"

namespace skein::record {

/// Where one object was: its recorded motions, in order of time.
class ObjectTrack {
 public:
  /// Not before those added earlier.
  void add(const ObjectMotion& motion) { motions_.push_back(motion); }

  /// Where it was at a time [m]; none: nothing is known of then.
  std::optional<Vec2> at(Time time) const {
    const auto after =
        std::upper_bound(motions_.begin(), motions_.end(), time,
                         [](Time t, const ObjectMotion& m) { return t < m.time; });
    if (after == motions_.begin()) return std::nullopt;
    return std::prev(after)->at(time);
  }

  const std::vector<ObjectMotion>& motions() const { return motions_; }

 private:
  std::vector<ObjectMotion> motions_;
};

}  // namespace skein::record
