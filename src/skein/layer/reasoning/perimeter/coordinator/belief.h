// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "skein/layer/reasoning/perimeter/coordinator/crossing_detector.h"
#include "skein/layer/reasoning/perimeter/coordinator/forecast.h"
#include "skein/role/perimeter_estimator.h"

namespace skein::perimeter {

/// The coordinator's belief about the perimeter: an estimator that is fed readings in the
/// order of their own times, however late they arrive.
///
/// Checkpoints of the estimator are kept over a window. A reading older than what was
/// already used goes back to the checkpoint before it and everything since is used again,
/// in order; a reading older than the window is dropped.
class Belief {
 public:
  /// @param window  how late a reading may come and still count [s].
  Belief(std::unique_ptr<PerimeterEstimator> estimator, double window);

  /// Uses `readings` (any order). Returns the crossings among them that had not been seen
  /// before, in order of time.
  std::vector<Crossing> take(std::vector<HeardReading> readings);

  /// Carries the belief on to `time`, if it is not there already; readings from before
  /// that are late from then on.
  void predict(Time time);

  /// Time of the last reading used or prediction made.
  Time time() const { return now_.time; }

  /// The boundary, moved on from the belief's own time to `now` with each point's rate.
  BoundaryEstimate boundary_at(Time now);

  /// Begins to look ahead of `now`, which is not before its own time.
  ForecastRun look_ahead(Time now, const ForecastOptions& options, double spread) const {
    return {*now_.estimator, now, options, spread};
  }

  EstimatorHealth health() const { return now_.estimator->health(); }
  int dropped() const { return dropped_; }

 private:
  struct Checkpoint {
    Time time;  ///< all readings up to here have been used
    std::unique_ptr<PerimeterEstimator> estimator;
    CrossingDetector detector;
    Checkpoint copy() const { return {time, estimator->clone(), detector}; }
  };

  std::vector<Crossing> use(const HeardReading& heard);
  void keep_checkpoint();

  double window_;
  Checkpoint now_;
  std::deque<Checkpoint> checkpoints_;  // oldest first
  std::vector<HeardReading> history_;   // since the oldest checkpoint, in order of time
  std::optional<BoundaryEstimate> boundary_;  // of its own time, as long as it is known
  int dropped_ = 0;
};

}  // namespace skein::perimeter
