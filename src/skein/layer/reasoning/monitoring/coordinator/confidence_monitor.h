#pragma once

#include <deque>
#include <map>
#include <optional>

#include "skein/data/fire.h"

namespace skein::monitoring {

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

 private:
  struct Pending {
    Time time;
    bool entered = false;
    std::optional<bool> outside;  // none: no boundary was believed, or taken back
  };

  std::optional<Verdict> judge(bool outside);

  std::map<EntityId, Pending> pending_;  // the newest of each aircraft
  std::deque<bool> outside_;             // newest last
  std::optional<Verdict> verdict_;
};

}  // namespace skein::monitoring
