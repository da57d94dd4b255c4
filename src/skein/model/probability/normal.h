// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "skein/base/math.h"

namespace skein::model {

inline constexpr double kInvSqrt2Pi = std::numbers::inv_sqrtpi / std::numbers::sqrt2;

/// Scaled complementary error function, exp(x^2) erfc(x); never underflows for x > 0.
/// Relative error below 2e-15 for x > -0.4, and about x^2 times rounding
/// below; +inf where the value exceeds the range (x < -26.6).
/// Reference: [Cody69] rational Chebyshev approximations.
double erfcx(double x);

/// Standard normal density.
inline double normal_pdf(double x) {
  return kInvSqrt2Pi * math::exp(-0.5 * x * x);
}

/// Mass of the standard normal above x, 1 - Phi(x). Relative accuracy 1e-13 or better
/// wherever the result is a normal number (x < 37.5).
double normal_upper(double x);

/// Standard normal distribution function Phi(x), accurate in both tails.
inline double normal_cdf(double x) {
  return normal_upper(-x);
}

/// log(1 - Phi(x)), finite for every finite x with x^2 finite.
double log_normal_upper(double x);

/// log Phi(x).
inline double log_normal_cdf(double x) {
  return log_normal_upper(-x);
}

/// Mills ratio (1 - Phi(x)) / phi(x) of x, without under- or overflow for x > -37.
double mills_ratio(double x);

/// Continuous ranked probability score of the forecast N(mean, sd^2) when `value` came
/// true, in the unit of `value`; smaller is better, |value - mean| for sd = 0.
///
///   sd [ w (2 Phi(w) - 1) + 2 phi(w) - 1/sqrt(pi) ],   w = (value - mean)/sd
///
/// @param sd  not negative.
/// Reference: [Gneiting05].
double gaussian_crps(double mean, double sd, double value);

}  // namespace skein::model
