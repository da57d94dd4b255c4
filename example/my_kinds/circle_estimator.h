// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/role/perimeter_estimator.h"

namespace my_kinds {

struct CircleOptions {
  int points = 72;          ///< of the boundary
  double shape_sd = 60;     ///< how far a real boundary lies from a circle [m]
  double rate_walk = 0.01;  ///< how the rate of spread changes [m/s per root second]
};

/// A perimeter that stays a circle about the believed origin: radius and rate of spread,
/// by a Kalman filter over the crossings.
///
///   x = (radius, rate),  radius' = rate,  crossing = radius + shape + position
///
/// Valid: fires without wind. What a circle cannot follow is in `shape_sd`, so the belief
/// stays wide; the built-in estimators know better.
class CircleEstimator final : public skein::PerimeterEstimator {
 public:
  CircleEstimator(const CircleOptions& options, const skein::PerimeterPrior& prior);

  void predict(skein::Time time) override;
  /// A reading without a crossing says nothing about a radius: only the time counts.
  void observe(const skein::FireReading& reading) override;
  void observe(const skein::Crossing& crossing) override;
  skein::BoundaryEstimate boundary() const override;
  skein::EstimatorHealth health() const override { return health_; }
  std::unique_ptr<skein::PerimeterEstimator> clone() const override {
    return std::make_unique<CircleEstimator>(*this);
  }

 private:
  CircleOptions options_;
  skein::Vec2 origin_;
  skein::Time time_;
  double radius_, rate_;           // [m], [m/s]
  double p_rr_, p_rs_ = 0, p_ss_;  // their covariance
  skein::EstimatorHealth health_;
};

}  // namespace my_kinds
