// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/data/perimeter/fire.h"
#include "skein/record/figures/metrics.h"

namespace skein::record {

/// How long ago each part of the boundary was last crossed by an aircraft.
///
/// Markers on the true boundary remember when it was last crossed there. They move with
/// the front (each to the nearest point of the newest boundary), because the place of an
/// old crossing has long burnt: what stays is the part of the front that it observed. New
/// markers fill the gaps of a growing front and remember what their neighbour does. A
/// crossing counts for the 100 m around it; what was never crossed, or has sprung up away
/// from the rest, counts from the start of the run.
class ReadingAges {
 public:
  /// Takes a crossing; they may come in any order.
  void add(const Crossing& crossing) {
    crossings_.push_back({crossing.time, crossing.point});
  }

  struct Ages {
    double mean = 0;  ///< over the believed points [s]
    double max = 0;   ///< [s]
  };

  /// The ages at `now`; absent when the truth or the belief has no boundary.
  /// Cost: some 200 to 600 markers, squared, and times the believed points.
  std::optional<Ages> ages(Time now, const TrueBoundary& truth,
                           const BoundaryEstimate& belief);

 private:
  struct Marker {
    Time crossed;
    Vec2 point;
  };

  void move_markers(const TrueBoundary& truth, double spacing);
  void fill_gaps(const TrueBoundary& truth, double spacing);
  void apply_crossings(const TrueBoundary& truth, double spacing);

  std::vector<Marker> markers_;
  std::vector<Marker> crossings_;  // since the last call
};

}  // namespace skein::record
