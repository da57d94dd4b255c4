// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "skein/data/traffic/traffic.h"

namespace skein::record {

/// Where one aircraft of other traffic was: its recorded motions, in order of time.
class TrafficPath {
 public:
  /// Not before those added earlier.
  void add(const TrafficMotion& motion) { motions_.push_back(motion); }

  /// How it flew at a time; null: nothing is known of then, or it was not there.
  const TrafficMotion* at(Time time) const {
    const auto after =
        std::upper_bound(motions_.begin(), motions_.end(), time,
                         [](Time t, const TrafficMotion& m) { return t < m.time; });
    if (after == motions_.begin()) return nullptr;
    const TrafficMotion& motion = *std::prev(after);
    return is_there(motion.phase) ? &motion : nullptr;
  }

  const std::vector<TrafficMotion>& motions() const { return motions_; }

 private:
  std::vector<TrafficMotion> motions_;
};

}  // namespace skein::record
