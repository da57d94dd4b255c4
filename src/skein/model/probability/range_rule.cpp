// SPDX-License-Identifier: Apache-2.0
#include "skein/model/probability/range_rule.h"

#include <algorithm>

#include "skein/base/check.h"

namespace skein::model {

const char* range_rule_name(RangeRule rule) {
  switch (rule) {
    case RangeRule::kExact:
      return "qkf";
    case RangeRule::kMle:
      return "mle";
    case RangeRule::kMap:
      return "map";
    case RangeRule::kUkf:
      return "ukf";
    case RangeRule::kGainA15:
      return "qkf-a15";
  }
  SKEIN_CHECK(false, static_cast<int>(rule));
  return "";
}

double mle_value(double bound, Side side, double sigma_v) {
  return side == Side::kAbove ? bound + 2 * sigma_v : bound - 2 * sigma_v;
}

double map_value(double mean, double sd, double bound, Side side, double sigma_v) {
  SKEIN_CHECK(sd > 0 && sigma_v > 0, sd, sigma_v);
  // Mirrored and scaled, so that the prior is N(0, 1) and the bound a lower one.
  const double sign = side == Side::kAbove ? 1 : -1;
  const double a = sign * (bound - mean) / sd, s = sigma_v / sd;
  double z = std::max(0.0, a);
  // Derivative of the negative log posterior: increasing and concave, so that Newton's
  // method converges from anywhere, and from the left of the root without overshoot.
  for (int step = 0; step < 100; ++step) {
    const double w = (z - a) / s;
    const double lambda = standard_above(-w).mean;  // phi(w)/Phi(w)
    const double slope = 1 + lambda * (lambda + w) / (s * s);
    const double move = (lambda / s - z) / slope;
    z += move;
    if (std::abs(move) <= 1e-15 * std::abs(z)) break;
  }
  return mean + sign * sd * z;
}

SigmaPoints ukf_points(double mean, double sd, const Interval& interval) {
  return {std::clamp(mean - sd, interval.lower, interval.upper),
          std::clamp(mean + sd, interval.lower, interval.upper)};
}

Moments correct_range(RangeRule rule, double mean, double variance, double bound,
                      Side side, double sigma_v) {
  const double sd = std::sqrt(variance);
  const Moments exact = truncate_one_sided(mean, sd, bound, side);
  double value = exact.mean;
  switch (rule) {
    case RangeRule::kExact:
      return exact;
    case RangeRule::kMle:
      value = mle_value(bound, side, sigma_v);
      break;
    case RangeRule::kMap:
      value = map_value(mean, sd, bound, side, sigma_v);
      break;
    case RangeRule::kUkf: {
      Interval interval;
      (side == Side::kAbove ? interval.lower : interval.upper) = bound;
      value = ukf_points(mean, sd, interval).mean();
      break;
    }
    case RangeRule::kGainA15: {
      const double share = variance / (variance + exact.variance);
      return {mean + share * (exact.mean - mean), share * exact.variance};
    }
  }
  return {value, second_moment(exact, value)};
}

}  // namespace skein::model
