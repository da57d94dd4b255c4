// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "skein/model/probability/half_space_update.h"

namespace skein::perimeter {

/// What one in/out reading says about one control point, before any rule has used it.
struct HalfSpace {
  Vec2 aircraft = Vec2::Zero();  ///< where the reading was taken [m]
  double noise = 1;              ///< variance of the range [m^2]
  model::Side side = model::Side::kAbove;
  model::LineOfSight seen;  ///< the point, seen from there
};

/// The replaceable part of a pointwise estimator: what readings teach a control point.
///
/// To add an estimator: derive from this class (gaussian_rule.h is the shortest example)
/// and give it a row in pointwise_kinds.cpp. Geometry, gate, expected readings and the
/// choice of points are in PointwiseEstimator and the same for all.
///
/// A rule leaves in each ControlPoint the mean and covariance of its belief; a rule with
/// a richer belief (particles) keeps that itself, by the point's index.
class PointRule {
 public:
  virtual ~PointRule() = default;

  /// Called once, with the points of the prior.
  virtual void start(std::span<const model::ControlPoint>) {}

  /// Carries all points on by `dt` [s].
  /// @param noise  spectral density of the acceleration per axis [m^2/s^3].
  virtual void predict(std::span<model::ControlPoint> points, double dt, double noise) {
    for (model::ControlPoint& point : points) model::predict_point(point, dt, noise);
  }

  /// A reading puts point `index` on one side of an aircraft. Only within the gate.
  virtual void half_space(std::size_t index, model::ControlPoint& point,
                          const HalfSpace& reading) = 0;

  /// The boundary passes through `where`, known to `sd` [m] per axis, and `index` is the
  /// point it is taken for.
  virtual void crossing(std::size_t index, model::ControlPoint& point, const Vec2& where,
                        double sd) = 0;

  virtual std::unique_ptr<PointRule> clone() const = 0;
};

}  // namespace skein::perimeter
