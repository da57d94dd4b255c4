// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>

#include "skein/data/perimeter/fire.h"

namespace skein {

/// How surprising the observations were.
struct EstimatorHealth {
  int observations = 0;
  int outliers = 0;  ///< observations set aside because they were all but impossible
  /// What the belief is made with now, for estimators that change it; else empty.
  std::string_view method;
};

/// A belief about where a fire's boundary is, with its uncertainty.
///
/// Used in this order: predict to the time of an observation, observe, ask. Times never
/// go back; observations that arrive late are the business of the caller, who replays
/// them on a clone().
class PerimeterEstimator {
 public:
  virtual ~PerimeterEstimator() = default;

  /// Carries the belief on to `time`.
  virtual void predict(Time time) = 0;

  /// Learns from an in/out reading taken at the current time.
  virtual void observe(const FireReading& reading) = 0;

  /// Learns from a crossing at the current time. It stands for the later of its two
  /// readings, which is not given to observe(const FireReading&) as well.
  virtual void observe(const Crossing& crossing) = 0;

  /// The believed boundary at the current time.
  virtual BoundaryEstimate boundary() const = 0;

  /// One to look ahead with: it is only predicted and asked, and may be quicker and
  /// coarser than this one. A clone, unless an estimator knows better.
  virtual std::unique_ptr<PerimeterEstimator> outlook() const { return clone(); }

  virtual EstimatorHealth health() const = 0;
  virtual std::unique_ptr<PerimeterEstimator> clone() const = 0;
};

}  // namespace skein
