// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <map>
#include <optional>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein::record {

/// The horizontal error of estimates against the truth at their own times.
///
/// The estimate of an aircraft elsewhere is of the time when that said it, between two
/// recorded truths: those are joined by the cubic that has their places and velocities.
/// An estimate that is recorded again counts once. What an aircraft that has never said
/// anything begins with is no estimate: the first one counts once another follows.
class PositionError {
 public:
  void truth(Time time, EntityId id, const Vec2& p, const Vec2& v);
  /// After the truth of its time, or of a later one.
  void estimate(Time time, EntityId id, const Vec2& p);

  /// RMS [m]; none where there was nothing to compare.
  std::optional<double> rms() const;

 private:
  struct Place {
    Time time;
    Vec2 p, v;
  };
  struct Track {
    std::deque<Place> truths;     // of late
    std::optional<Time> last;     // estimate
    std::optional<double> first;  // square of the first one's error [m^2]
  };
  std::optional<Vec2> truth_at(const Track& track, Time time) const;

  std::map<EntityId, Track> tracks_;
  double sum_ = 0, count_ = 0;
};

}  // namespace skein::record
