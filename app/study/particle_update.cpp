// SPDX-License-Identifier: Apache-2.0
#include "app/study/particle_update.h"

#include "skein/layer/reasoning/perimeter/pointwise/particle_rule.h"

namespace skein::app {

model::Moments particle_update(double mean, double variance, double bound,
                               model::Side side, double sigma_v) {
  // One control point on the north axis, seen from an aircraft that stands on the bound:
  // its distance to the north is the range.
  model::ControlPoint point;
  point.mean.x() = mean;
  point.covariance(0, 0) = variance;
  perimeter::HalfSpace reading;
  reading.aircraft = Vec2(bound, 0);
  reading.noise = sigma_v * sigma_v;
  reading.side = side;
  reading.seen = {Vec2(1, 0), mean - bound, variance + reading.noise,
                  Eigen::Vector4d(variance, 0, 0, 0)};
  perimeter::ParticleRule rule(1000, 0, 1);
  rule.start({&point, 1});
  rule.half_space(0, point, reading);
  return {point.mean.x(), point.covariance(0, 0)};
}

}  // namespace skein::app
