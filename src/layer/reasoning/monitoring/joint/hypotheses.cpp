#include <algorithm>

#include "layer/reasoning/monitoring/joint/joint_estimator.h"

namespace skein::monitoring {

std::vector<BoundaryHypothesis> boundary_hypotheses(const PerimeterPrior& prior) {
  const double mean_rate_sd = std::max(prior.rate_sd, 0.1 * prior.rate);
  BoundaryHypothesis smooth;
  smooth.weight = 0.6;
  smooth.radius = {prior.radius_sd, 6};
  smooth.rate = {prior.rate_sd, 8};
  smooth.mean_rate_sd = mean_rate_sd;
  // A wind as strong as the spread would drive the fire over its own origin.
  smooth.wind_sd = std::min(prior.wind_sd, 0.5 * prior.rate);
  smooth.rate_drift = 0.001 * prior.rate_sd;

  BoundaryHypothesis red = smooth;
  red.radius = {prior.radius_sd, 2, 3.5};
  red.rate = {prior.rate_sd, 2, 3.5};

  BoundaryHypothesis rough = smooth;
  rough.weight = 0.3;
  rough.radius.cutoff = 10;
  rough.rate.cutoff = 60;
  rough.rate_drift = 0.005 * prior.rate_sd;
  rough.texture_rate = 0.13 * prior.rate_sd;

  BoundaryHypothesis unsteady = smooth;
  unsteady.weight = 0.1;
  unsteady.radius.cutoff = 10;
  unsteady.rate.sd = 2 * prior.rate_sd;
  unsteady.rate.cutoff = 15;
  unsteady.rate_drift = 0.03 * prior.rate_sd;
  return {red, smooth, rough, unsteady};
}

}  // namespace skein::monitoring
