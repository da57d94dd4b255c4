#pragma once

#include <deque>
#include <optional>

#include "data/fire.h"

namespace skein::monitoring {

/// Watches, without any truth, whether a belief knows as much as it says: a crossing
/// should lie within two of the stated sigmas of the boundary that was believed before
/// it, 19 times of 20.
class ConfidenceMonitor {
 public:
  enum class Verdict { kOverConfident, kTrustedAgain };

  /// Compares a crossing with the boundary `before` it was known, carried on to the time
  /// of the crossing. Returns the verdict when it changes.
  std::optional<Verdict> take(const Crossing& crossing, const BoundaryEstimate& before);

  /// Share of the recent crossings that lay outside their band [-].
  double share_outside() const;

 private:
  std::deque<bool> outside_;  // newest last
  bool over_confident_ = false;
};

}  // namespace skein::monitoring
