// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/layer/reasoning/perimeter/joint/boundary_filter.h"
#include "skein/model/probability/error_rate.h"
#include "skein/role/perimeter_estimator.h"

namespace skein::perimeter {

struct JointOptions {
  int control_points = 60;  ///< of the reported ring, at equal bearings [-]
  double spacing = 0;       ///< if above 0: equal arc length of at most this instead [m]
  int knots = 90;     ///< spline coefficients of the radius, and as many of the rate [-]
  int aircraft = 16;  ///< room for so many at first; more are taken in as they come [-]
  double period = 1;  ///< time between readings where it cannot be seen from them [s]
  double position_correlation =
      20;                    ///< time over which position errors wander; 0 = white [s]
  double false_rate = 1e-3;  ///< probability that a reading is wrong, at first [-]
  double outlier = 1e-6;     ///< readings less probable than this are set aside [-]
  int patience = 2;  ///< outliers in a row before the belief is corrected instead [-]
  double growth_horizon = 60;  ///< time over which sigma_growth is the mean [s]
};

/// The hypotheses that a bank weighs against each other, for a prior.
std::vector<BoundaryHypothesis> boundary_hypotheses(const PerimeterPrior& prior);

/// "joint": the boundary's radius over bearing and its rate as one Gaussian per
/// hypothesis about their smoothness, the hypotheses weighted by how probable they made
/// the readings.
///
/// See docs/estimator-joint.md for the equations and what was measured.
/// Cost: an update takes O(n^2) in the number of unknowns n per hypothesis; predict() and
/// observe() allocate nothing, except when an aircraft beyond `options.aircraft` appears.
/// Valid: the fire is star-shaped about the prior's origin, or nearly so.
class JointEstimator : public PerimeterEstimator {
 public:
  JointEstimator(const PerimeterPrior& prior, const JointOptions& options);
  /// With hypotheses of the caller's own; at least one.
  JointEstimator(const PerimeterPrior& prior, const JointOptions& options,
                 const std::vector<BoundaryHypothesis>& hypotheses);

  void predict(Time time) override;
  void observe(const FireReading& reading) override;
  void observe(const Crossing& crossing) override;
  BoundaryEstimate boundary() const override;
  EstimatorHealth health() const override { return health_; }
  std::unique_ptr<PerimeterEstimator> clone() const override;

  /// Present weights of the hypotheses; they add up to 1.
  const std::vector<double>& weights() const { return weights_; }
  const BoundaryFilter& filter(int hypothesis) const {
    return filters_[static_cast<std::size_t>(hypothesis)];
  }
  /// Probability that a reading is wrong, as learned so far.
  double false_rate() const { return false_rate_.mean(); }
  /// Moments of the mixture at one bearing.
  BoundaryFilter::Local at(double bearing) const;

 private:
  struct Aircraft {
    EntityId id;
    Time last;  // reading before the present one
    bool has_last = false;
    bool crossed = false;  // the last reading was the later one of a crossing
    bool has_crossed = false;
    Time last_crossing;
    int suspects = 0;  // outliers in a row
    // A reading that changed sides and may be false, until the next one confirms it or
    // takes it back.
    std::optional<PolarReading> held;
    Time held_since;
  };
  int slot(EntityId id);
  void restart_invalid();
  void read(const FireReading& reading, bool changed);
  void learn(EntityId id, PolarReading reading, bool changed);
  void note(Aircraft& aircraft, PolarReading& reading);
  void settle_held(int index, const PolarReading& next);
  bool may_be_false(const PolarReading& reading) const;
  void use(int index, const PolarReading& reading);
  BoundaryPoint point_at(double bearing) const;
  double blur(const BoundaryFilter::Local& local) const;
  std::vector<double> spaced_bearings(double spacing) const;

  PerimeterPrior prior_;
  JointOptions options_;
  Time time_;
  EstimatorHealth health_;
  model::ErrorRate false_rate_;
  std::vector<BoundaryHypothesis> hypotheses_;
  std::vector<BoundaryFilter> filters_;
  std::vector<double> prior_weights_, weights_, evidence_;
  std::vector<Aircraft> aircraft_;
};

}  // namespace skein::perimeter
