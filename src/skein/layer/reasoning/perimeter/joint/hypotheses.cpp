// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "skein/layer/reasoning/perimeter/joint/joint_estimator.h"

namespace skein::perimeter {

std::vector<BoundaryHypothesis> boundary_hypotheses(const PerimeterPrior& prior) {
  const double mean_rate_sd = std::max(prior.rate_sd, 0.05 * prior.rate);
  BoundaryHypothesis smooth;
  smooth.weight = 0.6;
  smooth.radius = {prior.radius_sd, 6};
  smooth.rate = {prior.rate_sd, 8};
  smooth.mean_rate_sd = mean_rate_sd;
  // A wind as strong as the spread would drive the fire over its own origin.
  smooth.wind_sd = std::min(prior.wind_sd, 0.5 * prior.rate);
  smooth.rate_drift = 0.006 * prior.rate_sd;

  BoundaryHypothesis red = smooth;
  red.radius = {prior.radius_sd, 2, 5};
  red.rate = {prior.rate_sd, 2, 5};
  red.rate_drift = 0.0001 * prior.rate_sd;

  BoundaryHypothesis rough = smooth;
  rough.weight = 0.3;
  rough.radius = red.radius;
  rough.rate.cutoff = 60;
  rough.rate_drift = 0.001 * prior.rate_sd;
  rough.texture_rate = 0.2 * prior.rate_sd;

  BoundaryHypothesis jagged = smooth;
  jagged.weight = 0.3;
  jagged.radius = {prior.radius_sd, 24, 8};

  return {red, smooth, rough, jagged};
}

}  // namespace skein::perimeter
