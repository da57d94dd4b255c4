// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/model/probability/truncated_normal.h"

namespace skein::model {

/// The rules that turn "the range is on this side of the bound" into a corrected range.
/// To add one: a row here, a case in correct_range(), a name in range_rule_name().
enum class RangeRule {
  kExact,    ///< truncated moments: the QKF of the thesis
  kMle,      ///< most likely value of a noisy bound
  kMap,      ///< most probable value, prior and noisy bound together
  kUkf,      ///< two sigma points, clipped
  kGainA15,  ///< exact mean, "optimal" gain (A.15): an ablation, over-confident
};
inline constexpr RangeRule kRangeRules[] = {RangeRule::kExact, RangeRule::kMle,
                                            RangeRule::kMap, RangeRule::kUkf,
                                            RangeRule::kGainA15};

/// "qkf", "mle", "map", "ukf", "qkf-a15".
const char* range_rule_name(RangeRule rule);

/// What a scalar prior N(mean, variance) becomes under `rule` when it is reported to be
/// on one side of `bound`.
///
/// For the approximations the variance is the second moment about the value they choose,
/// by the identity  var[z|A] + (z* - E[z|A])^2: never below the exact one.
/// For kGainA15 the result stands for the gain P H'/(S + C) in units of the usual one:
/// value - mean is multiplied by S/(S + C), the variance becomes S C/(S + C).
///
/// @param variance  positive.
/// @param sigma_v   standard deviation of the bound that MLE and MAP assume, positive;
///                  others ignore it.
/// Reference: [Rabinovich18] Eq. (2.25), (2.26), (2.34)-(2.60), (A.15), corrected.
Moments correct_range(RangeRule rule, double mean, double variance, double bound,
                      Side side, double sigma_v);

/// The MLE's choice, two sigma_v beyond the bound.
double mle_value(double bound, Side side, double sigma_v);

/// The maximum of prior density times the probability of the side under a bound with
/// noise sigma_v; unique, because the product is log-concave. Found by Newton's method.
/// @param sd, sigma_v  positive.
/// Reference: [Rabinovich18] chapter 2.
double map_value(double mean, double sd, double bound, Side side, double sigma_v);

/// The two sigma points mean -+ sd, each clipped to the interval.
struct SigmaPoints {
  double low, high;
  double mean() const { return 0.5 * (low + high); }
};
SigmaPoints ukf_points(double mean, double sd, const Interval& interval);

/// E[(z - value)^2 | A]: variance plus squared bias.
inline double second_moment(const Moments& exact, double value) {
  const double bias = value - exact.mean;
  return exact.variance + bias * bias;
}

}  // namespace skein::model
