// SPDX-License-Identifier: Apache-2.0
#include "circle_estimator.h"

#include <cmath>

namespace my_kinds {

using skein::math::squared;

CircleEstimator::CircleEstimator(const CircleOptions& options,
                                 const skein::PerimeterPrior& prior)
    : options_(options),
      origin_(prior.origin),
      radius_(prior.radius),
      rate_(prior.rate),
      p_rr_(squared(prior.radius_sd)),
      p_ss_(squared(prior.rate_sd)) {}

void CircleEstimator::predict(skein::Time time) {
  const double dt = (time - time_).seconds();
  time_ = time;
  radius_ += rate_ * dt;
  p_rr_ += dt * (2 * p_rs_ + dt * p_ss_);
  p_rs_ += dt * p_ss_;
  p_ss_ += squared(options_.rate_walk) * dt;
}

void CircleEstimator::observe(const skein::FireReading&) {
  ++health_.observations;
}

void CircleEstimator::observe(const skein::Crossing& crossing) {
  ++health_.observations;
  // The boundary lies anywhere between the two readings: a twelfth of the distance
  // squared.
  const double r = squared(options_.shape_sd) + squared(crossing.point_sd) +
                   crossing.track.squaredNorm() / 12;
  const double innovation = (crossing.point - origin_).norm() - radius_;
  const double s = p_rr_ + r;
  constexpr double kGate = 5;  // standard deviations
  if (squared(innovation) > squared(kGate) * s) {
    ++health_.outliers;
    return;
  }
  const double gain_r = p_rr_ / s, gain_s = p_rs_ / s;
  radius_ += gain_r * innovation;
  rate_ += gain_s * innovation;
  p_ss_ -= gain_s * p_rs_;
  p_rs_ -= gain_r * p_rs_;
  p_rr_ -= gain_r * p_rr_;
}

skein::BoundaryEstimate CircleEstimator::boundary() const {
  skein::BoundaryEstimate estimate;
  estimate.time = time_;
  estimate.rings.resize(1);
  const double sigma = std::sqrt(p_rr_ + squared(options_.shape_sd));
  for (int k = 0; k < options_.points; ++k) {
    const skein::Vec2 normal =
        skein::geo::unit(2 * skein::geo::kPi * k / options_.points);
    skein::BoundaryPoint point;
    point.position = origin_ + std::fmax(radius_, 1.0) * normal;
    point.normal = normal;
    point.sigma = sigma;
    point.sigma_growth = p_rs_ / sigma;
    point.rate = rate_;
    estimate.rings[0].push_back(point);
  }
  return estimate;
}

}  // namespace my_kinds
