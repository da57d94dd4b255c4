// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "skein/base/math.h"
#include "skein/model/probability/error_function.h"
#include "skein/model/probability/normal.h"

namespace skein::model {

/// A stretch of the real line; either end may be infinite, lower < upper.
struct Interval {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// Which half of a line a bound leaves.
enum class Side {
  kAbove,  ///< values above the bound
  kBelow,  ///< values below the bound
};

/// First two moments of a scalar.
struct Moments {
  double mean = 0;
  double variance = 0;
};

/// Moments of a standard normal that is known to be above `alpha`.
///
///   mean = lambda = phi(alpha)/(1 - Phi(alpha)),   variance = 1 - lambda (lambda -
///   alpha)
///
/// Relative accuracy 1e-11 or better for every alpha (1e3 sigma included), mean included:
/// the closed form from Phi alone has no digit left at 8.
/// Cost:      about 15 ns.
/// Reference: [Rabinovich18] Eq. (2.25), (2.26), corrected.
inline Moments standard_above(double alpha);

/// A normal variable cut to an interval.
struct TruncatedNormal {
  double mass = 0;  ///< probability of the interval before the cut; may underflow to 0
  double log_mass = 0;  ///< its logarithm; does not underflow
  double mean = 0;
  double variance = 0;
};

/// Mass, mean and variance of N(mean, sd^2) on `interval`.
///
/// Accurate to about 1e-11 relative (mean: relative to the larger of itself and the
/// distance it moved), far in a tail and for narrow intervals too.
/// @param sd  positive.   @param interval  lower < upper. Anything else: Bug.
/// Reference: [Rabinovich18] Eq. (2.25)-(2.27), corrected: printed, (2.26) repeats the
/// lower bound in its last term, and (2.27) swaps the bounds.
TruncatedNormal truncate_normal(double mean, double sd, const Interval& interval);

/// Mean and variance of N(mean, sd^2) given only that it is on one side of `bound`.
inline Moments truncate_one_sided(double mean, double sd, double bound, Side side) {
  const double sign = side == Side::kAbove ? 1 : -1;
  const Moments cut = standard_above(sign * (bound - mean) / sd);
  return {mean + sign * sd * cut.mean, sd * sd * cut.variance};
}

/// What an unreliable reading leaves of a normal variable.
struct MixtureMoments {
  double likelihood = 0;  ///< probability of the reading before it came
  double mean = 0;
  double variance = 0;
};

/// Exact moments of z ~ N(mean, sd^2) after a reading that says on which side of `bound`
/// z is, and is wrong with a known probability: a mixture of the two half-normals.
///
/// @param if_above  probability of this reading when z > bound.
/// @param if_below  probability of this reading when z < bound. A reading "above" that is
///                  wrong with probability eps has if_above = 1 - eps, if_below = eps.
///                  Both in [0, 1], not both 0. Anything else: Bug.
MixtureMoments uncertain_half_line(double mean, double sd, double bound, double if_above,
                                   double if_below);

inline Moments standard_above(double alpha) {
  constexpr double kSqrt2OverPi = 0.79788456080286535588;
  const double x = std::abs(alpha) * (1 / std::numbers::sqrt2);
  double lambda;
  if (x < cody::kSmall) {
    const double sign = alpha < 0 ? -1 : 1;
    lambda = 2 * normal_pdf(alpha) / (1 - sign * cody::erf_small(x));
  } else if (x <= cody::kLarge) {
    const cody::Ratio ratio = cody::erfcx_middle(x);
    if (alpha > 0) {
      lambda = kSqrt2OverPi * ratio.below / ratio.above;
    } else {
      const double e = math::exp(-0.5 * alpha * alpha);
      lambda = kInvSqrt2Pi * e * ratio.below / (ratio.below - 0.5 * e * ratio.above);
    }
  } else if (alpha < 0) {
    // Beyond 5.7 sigma the mass that is missing (< 1e-8) still counts.
    lambda = normal_pdf(alpha) / (1 - normal_pdf(alpha) * mills_ratio(-alpha));
  } else if (alpha < 50) {
    const double t = cody::deficit_large(x);
    const double r = 1 - t;
    return {alpha / r, (r * r - alpha * alpha * t) / (r * r)};
  } else {
    const double y = 1 / (alpha * alpha);
    return {alpha * (1 + y * (1 - y * (2 - y * (10 - 74 * y)))),
            y * (1 - y * (6 - y * (50 - y * (518 - 6354 * y))))};
  }
  return {lambda, 1 - lambda * (lambda - alpha)};
}

}  // namespace skein::model
