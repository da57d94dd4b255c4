// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "skein/layer/reasoning/perimeter/pointwise/point_rule.h"
#include "skein/role/perimeter_estimator.h"

namespace skein::perimeter {

/// What all pointwise estimators share, and what only some of them use.
struct PointwiseOptions {
  int control_points = 60;      ///< points of the boundary, at least 8
  double gate_sigmas = 3;       ///< a reading counts for points nearer than this many
                                ///< standard deviations of the range [-]
  double process_noise = 1e-6;  ///< spectral density of the points' acceleration per axis
                                ///< [m^2/s^3]; 1e-6 lets rates wander 0.06 m/s in an hour
  double sensor_sd = 1;         ///< standard deviation of the in/out sensor's range [m]
  bool use_crossings = true;    ///< a crossing corrects the nearest point; if not, it is
                                ///< an ordinary reading
  double sigma_v = 10;          ///< `mle`, `map`: standard deviation of the bound [m]
  int particles = 500;          ///< `particle`: samples per point, at least 20
  double false_rate = 0.01;     ///< `particle`: probability that a reading is false [-]
  double min_sd = 5;            ///< `point-reset`: floor after a crossing, per axis [m]
};

/// The thesis's belief: N control points of the boundary, each with a position and
/// velocity of its own, independent of the others. `PointRule` says what a reading
/// teaches a point.
///
/// A reading is compared with what the polygon of the points predicts. If it agrees,
/// every point stays beyond the aircraft as seen from there; if not, it is on the other
/// side. Known weaknesses, kept on purpose (docs/estimators-pointwise.md): readings from
/// one place count again and again, the line of sight is not the normal, and nothing
/// learned about one point helps its neighbours.
///
/// Reference: [Rabinovich18] algorithm 1, corrected, with the gate of figure A.1.
class PointwiseEstimator final : public PerimeterEstimator {
 public:
  /// Points at equal bearings on the prior's circle, in order of growing bearing;
  /// velocity is spread along the bearing plus the wind that is known.
  /// @param start  time of the prior.
  /// Fails: Bug when an option is out of its range.
  PointwiseEstimator(const PointwiseOptions& options, const PerimeterPrior& prior,
                     std::unique_ptr<PointRule> rule, Time start = {});

  void predict(Time time) override;
  void observe(const FireReading& reading) override;
  /// Corrects the point nearest in bearing (seen from the middle of all points) to the
  /// crossing, with variance |track|^2/12 + point_sd^2 per axis; for the other points the
  /// later reading is an ordinary one.
  void observe(const Crossing& crossing) override;
  BoundaryEstimate boundary() const override;
  /// Outliers: readings that contradict the predicted boundary where no point is within
  /// the gate, so that nothing could be learned from them.
  EstimatorHealth health() const override { return health_; }
  std::unique_ptr<PerimeterEstimator> clone() const override;

  std::span<const model::ControlPoint> points() const { return points_; }

 private:
  PointwiseEstimator(const PointwiseEstimator& other);

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  // Gives the reading to all points but `except`.
  void apply(const FireReading& reading, std::size_t except);
  Vec2 centre() const;
  std::size_t nearest_in_bearing(const Vec2& where) const;

  PointwiseOptions options_;
  std::unique_ptr<PointRule> rule_;
  Time now_;
  std::vector<model::ControlPoint> points_;
  std::vector<Vec2> ring_;  // scratch: the points' positions
  EstimatorHealth health_;
};

}  // namespace skein::perimeter
