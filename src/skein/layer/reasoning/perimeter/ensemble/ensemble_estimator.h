// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "skein/layer/reasoning/perimeter/confidence/unwatched_band.h"
#include "skein/layer/reasoning/perimeter/ensemble/front_ensemble.h"
#include "skein/model/probability/error_rate.h"
#include "skein/role/perimeter_estimator.h"

namespace skein::perimeter {

/// Estimates perimeters of any shape, with islands and holes, by an ensemble of level
/// sets; learns rates and drift as it goes. See docs/estimator-ensemble.md.
class EnsembleEstimator final : public PerimeterEstimator {
 public:
  EnsembleEstimator(const PerimeterPrior& prior, const EnsembleOptions& options);

  void predict(Time time) override;
  void observe(const FireReading& reading) override;
  void observe(const Crossing& crossing) override;
  BoundaryEstimate boundary() const override;
  EstimatorHealth health() const override { return health_; }
  std::unique_ptr<PerimeterEstimator> clone() const override;
  std::unique_ptr<PerimeterEstimator> outlook() const override;

  /// From now on it only looks ahead: FrontEnsemble::look_ahead().
  void look_ahead() { ensemble_.look_ahead(); }

  const FrontEnsemble& ensemble() const { return ensemble_; }
  /// Probability that a reading is wrong, as learned so far.
  double false_rate() const { return false_rate_.mean(); }

 private:
  // Observations of one aircraft that contradict the belief, until they are believed.
  struct Contradiction {
    int count = 0;
    Time first;
    bool inside = false;
  };
  struct Used {
    Time time;
    Vec2 point = Vec2::Zero();
  };
  struct AircraftMemory {
    Contradiction contradiction;
    std::map<bool, Used> used;  // by side
    // A crossing that may be false, until the next reading confirms it or takes it back.
    std::optional<Crossing> held;
  };

  // A crossing beside the believed boundary.
  struct Passage {
    MemberValues distance;  // of its middle
    double variance = 0;    // of the crossing itself, across the boundary [m^2]
    double innovation2 = 0;
    double probability = 0;  // that the boundary lies between the two readings
  };

  void settle_held(const Crossing& held, bool confirmed);
  Passage passage(const Crossing& crossing) const;
  void use(const Crossing& crossing);
  bool repeated(const FireReading& reading, const AircraftMemory& memory) const;
  bool confirmed(const FireReading& reading, AircraftMemory& memory);
  void believe(const Vec2& point, bool inside, const MemberValues& distance);
  void pass_through(const Vec2& point, const MemberValues& distance, double variance);
  void adapt(double innovation2, double share);

  EnsembleOptions options_;
  FrontEnsemble ensemble_;
  Time time_;
  EstimatorHealth health_;
  model::ErrorRate false_rate_;
  std::map<EntityId, AircraftMemory> memory_;
  UnwatchedBand unwatched_;
};

}  // namespace skein::perimeter
