// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/perimeter/pointwise/point_rule.h"
#include "skein/model/probability/range_rule.h"

namespace skein::perimeter {

/// Keeps each point Gaussian: the thesis's QKF, its three approximations and the ablation
/// of its gain, which differ only in the corrected range.
///
/// Reference: [Rabinovich18] algorithms 1 and 2, corrected.
class GaussianRule final : public PointRule {
 public:
  /// @param sigma_v  of the bound, for MLE and MAP [m], positive.
  GaussianRule(model::RangeRule rule, double sigma_v) : rule_(rule), sigma_v_(sigma_v) {}

  void half_space(std::size_t, model::ControlPoint& point,
                  const HalfSpace& reading) override {
    const model::LineOfSight& seen = reading.seen;
    correct_point(
        point, seen,
        correct_range(rule_, seen.range, seen.variance, 0, reading.side, sigma_v_));
  }
  void crossing(std::size_t, model::ControlPoint& point, const Vec2& where,
                double sd) override {
    locate_point(point, where, sd);
  }
  std::unique_ptr<PointRule> clone() const override {
    return std::make_unique<GaussianRule>(*this);
  }

 private:
  model::RangeRule rule_;
  double sigma_v_;
};

/// The estimator of the thesis's tracking benchmark: readings teach nothing, a crossing
/// puts the point there, with a small covariance; rates are never learned.
class ResetRule final : public PointRule {
 public:
  /// @param min_sd  floor of the standard deviation after a crossing, per axis [m].
  explicit ResetRule(double min_sd) : min_sd_(min_sd) {}

  void half_space(std::size_t, model::ControlPoint&, const HalfSpace&) override {}
  void crossing(std::size_t index, model::ControlPoint& point, const Vec2& where,
                double sd) override;
  std::unique_ptr<PointRule> clone() const override {
    return std::make_unique<ResetRule>(*this);
  }

 private:
  double min_sd_;
};

}  // namespace skein::perimeter
