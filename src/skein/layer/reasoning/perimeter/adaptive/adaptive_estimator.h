// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/layer/reasoning/perimeter/adaptive/observation_log.h"
#include "skein/layer/reasoning/perimeter/confidence/confidence_monitor.h"
#include "skein/layer/reasoning/perimeter/confidence/unwatched_band.h"
#include "skein/layer/reasoning/perimeter/ensemble/ensemble_estimator.h"
#include "skein/layer/reasoning/perimeter/joint/joint_estimator.h"

namespace skein::perimeter {

struct AdaptiveOptions {
  JointOptions joint;
  EnsembleOptions ensemble;
  /// The ensemble takes over when the crossings since it caught up were this much more
  /// probable under it, all together, and is given up when they were as much less [log].
  double lead = 40;
  int replay = 25;  ///< observations that the ensemble catches up with per new one [-]
};

/// "adaptive": begins as `joint`, and hands over to `ensemble` where the fire's shape is
/// not what `joint` assumes.
///
/// While the crossings agree with `joint` (ConfidenceMonitor), nothing else is computed.
/// When they contradict it, an ensemble is begun from the same prior and learns all that
/// was seen; once it has caught up, both forecast each crossing before they learn from
/// it. This is Wald's sequential test of one against the other: the ensemble takes over
/// for good, or is given up. Whichever is in use, reported deviations grow with what
/// recent crossings show to be missing.
///
/// Cost: that of `joint` and of one boundary() per crossing; during a trial that of both
/// estimators. The observations since the start are kept until then. An ensemble that was
/// given up is not tried again before as many crossings again.
class AdaptiveEstimator final : public PerimeterEstimator {
 public:
  AdaptiveEstimator(const PerimeterPrior& prior, const AdaptiveOptions& options);

  void predict(Time time) override;
  void observe(const FireReading& reading) override;
  void observe(const Crossing& crossing) override;
  BoundaryEstimate boundary() const override;
  EstimatorHealth health() const override;
  std::unique_ptr<PerimeterEstimator> clone() const override;
  std::unique_ptr<PerimeterEstimator> outlook() const override;

  /// Whether the ensemble has taken over.
  bool handed_over() const { return !joint_; }

 private:
  // An estimator with the record of its forecasts.
  template <class Estimator>
  struct Watched {
    explicit Watched(const Estimator& e) : estimator(e) {}
    // Judges the forecast of a crossing; the logarithm of the density that it gave to the
    // one that this decides about, if any.
    std::optional<double> judge(const Crossing& crossing) {
      const int before = forecasts.judged();
      forecasts.take(crossing, estimator.boundary());
      if (forecasts.judged() == before) return std::nullopt;
      return forecasts.last_log_density();
    }
    Estimator estimator;
    ConfidenceMonitor forecasts;
  };

  void learn(const Observation& observation);
  void catch_up();
  bool caught_up() const { return replayed_ == log_.size(); }
  void begin_trial();
  void decide();

  PerimeterPrior prior_;
  AdaptiveOptions options_;
  Time time_;
  std::optional<Watched<JointEstimator>> joint_;        // until it is given up
  std::optional<Watched<EnsembleEstimator>> ensemble_;  // since joint is suspected
  ObservationLog log_;                                  // while joint is in use
  std::size_t replayed_ = 0;                            // of the log, to the ensemble
  UnwatchedBand unwatched_;  // of joint; the ensemble has its own
  double lead_ = 0;          // of the ensemble over joint, since it caught up [log]
  int next_trial_ = 0;     // of the crossings judged, before the ensemble is tried again
  int past_outliers_ = 0;  // of an estimator given up
};

}  // namespace skein::perimeter
