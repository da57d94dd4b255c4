// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "skein/layer/reasoning/perimeter/confidence/crossing_offset.h"

namespace skein::perimeter {

/// Widens the band of a believed boundary where nobody has looked for long, by as much as
/// such parts turned out to be wrong before.
///
/// Along an edge that is being followed, crossings say little about the rest of a large
/// fire. So a crossing where the boundary was not seen for five minutes is compared with
/// what was believed before the aircraft came near: with a forecast that is some minutes
/// old. The squared errors over the stated variances are averaged in a way that follows
/// the worse parts of a fire rather than the mean, and what they exceed an honest
/// belief's by multiplies the variance of all parts that are unwatched now.
class UnwatchedBand {
 public:
  /// Whether it is time to keep another forecast.
  bool due(Time now) const;
  /// Keeps a boundary as it is believed now, without widen(), to judge by it later.
  void keep(BoundaryEstimate forecast);

  /// Notes that the boundary was crossed here.
  void see(const Crossing& crossing);

  /// Multiplies the deviations, and their growth, of points that were not seen lately.
  void widen(BoundaryEstimate& boundary) const;

  /// Factor on the deviation of parts unwatched for long [-]; at least 1.
  double factor() const;

 private:
  struct Sight {
    Time time;
    Vec2 place = Vec2::Zero();
  };

  // When the boundary near a place was last seen, not after `until`.
  bool seen(const Vec2& place, Time from, Time until) const;

  std::deque<BoundaryEstimate> forecasts_;  // oldest first
  std::deque<Sight> sights_;                // oldest first
  double square_ = 1;  // expectile of the squared errors over the stated variances
};

}  // namespace skein::perimeter
