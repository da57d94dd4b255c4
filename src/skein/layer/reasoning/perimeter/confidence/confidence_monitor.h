// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <map>
#include <optional>

#include "skein/layer/reasoning/perimeter/confidence/crossing_offset.h"

namespace skein::perimeter {

/// Watches, without any truth, whether a belief knows as much as it says: a crossing
/// should lie within two of the stated sigmas of the boundary that was believed before
/// it, 19 times of 20.
///
/// A crossing that the next readings of the same aircraft take back within 3 s counts
/// neither for nor against: it was a false reading, or a tip of the fire. So each is
/// judged when the next one of its aircraft is known.
class ConfidenceMonitor {
 public:
  enum class Verdict { kTrusted, kOverConfident };

  /// Compares a crossing with the boundary `before` it was known, carried on to the time
  /// of the crossing. Returns the verdict when it changes; the first comes with the
  /// twentieth crossing.
  std::optional<Verdict> take(const Crossing& crossing, const BoundaryEstimate& before);

  /// Share of the recent crossings that lay outside their band [-].
  double share_outside() const;
  /// Mean over the recent crossings of the squared distance from the believed boundary
  /// over its believed variance, each at most 25 [-]; 1 for an honest belief.
  double mean_square() const;
  /// Logarithm of the density that the belief gave to the crossing that was judged last,
  /// the distance limited as in mean_square() [log(1/m)]; 0 before the first.
  double last_log_density() const;
  /// How many crossings were judged so far [-].
  int judged() const { return judged_; }
  /// How many crossings were judged, the recent ones only [-]; at most 20.
  std::size_t recent() const { return recent_.size(); }

 private:
  struct Pending {
    Time time;
    bool entered = false;
    std::optional<CrossingOffset>
        offset;  // none: no boundary was believed, or taken back
  };

  std::optional<Verdict> judge(const CrossingOffset& offset);

  std::map<EntityId, Pending> pending_;  // the newest of each aircraft
  std::deque<CrossingOffset> recent_;    // newest last
  int judged_ = 0;
  std::optional<Verdict> verdict_;
};

}  // namespace skein::perimeter
