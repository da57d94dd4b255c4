// SPDX-License-Identifier: Apache-2.0
#include "skein/model/probability/truncated_normal.h"

#include <algorithm>
#include <array>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::model {

namespace {

// Ten-point Gauss-Legendre rule: positive nodes and their weights.
constexpr std::array<double, 5> kNode = {0.14887433898163121089, 0.43339539412924719080,
                                         0.67940956829902440623, 0.86506336668898451073,
                                         0.97390652851717172008};
constexpr std::array<double, 5> kWeight = {0.29552422471475287017, 0.26926671930999635509,
                                           0.21908636251598204400, 0.14945134915058059315,
                                           0.06667134430868813759};

// A standard normal cut to [alpha, beta].
struct Cut {
  double log_mass, mean, variance;
};

// A narrow interval: integrate over it, because the closed form is a difference of almost
// equal numbers. Relative to the middle c the density is exp(-c t - t^2/2); two panels of
// ten points are exact to rounding for half <= 1 and |c| half <= 3.
Cut cut_narrow(double c, double half) {
  double m0 = 0, m1 = 0, m2 = 0;
  for (std::size_t k = 0; k < kNode.size(); ++k)
    for (double sign : {-1.0, 1.0}) {
      const double u = 0.5 + 0.5 * sign * kNode[k];  // in [0, 1], and its mirror image
      const double t = half * u;
      const double weight = 0.5 * kWeight[k] * math::exp(-0.5 * t * t);
      const double right = weight * math::exp(-c * t), left = weight * math::exp(c * t);
      m0 += right + left;
      m1 += (right - left) * u;
      m2 += (right + left) * u * u;
    }
  const double shift = m1 / m0;
  return {math::log(kInvSqrt2Pi * half * m0) - 0.5 * c * c, c + half * shift,
          half * half * (m2 / m0 - shift * shift)};
}

// 1 - x M(x), with M the Mills ratio, for x >= 0.
double mills_deficit(double x) {
  const double u = x / std::numbers::sqrt2;
  return u > cody::kLarge ? cody::deficit_large(u) : 1 - x * mills_ratio(x);
}

// Both ends in the upper tail, 0 <= alpha: everything is scaled by phi(alpha).
Cut cut_tail(double alpha, double beta) {
  const double width = beta - alpha;
  const double d = math::exp(-0.5 * width * (alpha + beta));  // phi(beta)/phi(alpha)
  const double m_beta = mills_ratio(beta);
  const double z = mills_ratio(alpha) - d * m_beta;
  const double excess =
      (mills_deficit(alpha) - d * (mills_deficit(beta) + width * m_beta)) / z;
  const double mean = alpha + excess;
  return {-0.5 * alpha * alpha + math::log(kInvSqrt2Pi * z), mean,
          1 - mean * excess - width * d / z};
}

// A wide interval around 0.
Cut cut_middle(double alpha, double beta) {
  const double mass = 1 - normal_upper(-alpha) - normal_upper(beta);
  const double pa = normal_pdf(alpha), pb = normal_pdf(beta);
  const double mean = (pa - pb) / mass;
  return {math::log1p(-normal_upper(-alpha) - normal_upper(beta)), mean,
          1 + (alpha * pa - beta * pb) / mass - mean * mean};
}

// Of a finite interval with alpha + beta >= 0. The width is given apart: far out it may
// be too small for the difference of the ends.
Cut cut_finite(double alpha, double beta, double width) {
  const double middle = 0.5 * (alpha + beta), half = 0.5 * width;
  if (half <= 1 && half * middle <= 3) return cut_narrow(middle, half);
  return alpha >= 0 ? cut_tail(alpha, beta) : cut_middle(alpha, beta);
}

}  // namespace

TruncatedNormal truncate_normal(double mean, double sd, const Interval& interval) {
  const auto [lower, upper] = interval;
  SKEIN_CHECK(sd > 0 && lower < upper, sd, lower, upper);
  const double alpha = (lower - mean) / sd, beta = (upper - mean) / sd;
  if (std::isinf(alpha) && std::isinf(beta) && alpha < beta) return {1, 0, mean, sd * sd};
  if (std::isinf(beta)) {
    const Moments cut = standard_above(alpha);
    return {normal_upper(alpha), log_normal_upper(alpha), mean + sd * cut.mean,
            sd * sd * cut.variance};
  }
  if (std::isinf(alpha)) {
    const Moments cut = standard_above(-beta);
    return {normal_cdf(beta), log_normal_cdf(beta), mean - sd * cut.mean,
            sd * sd * cut.variance};
  }
  const double sign = alpha + beta >= 0 ? 1 : -1;
  const double width = (upper - lower) / sd;
  const Cut cut =
      sign > 0 ? cut_finite(alpha, beta, width) : cut_finite(-beta, -alpha, width);
  return {math::exp(cut.log_mass), cut.log_mass,
          std::clamp(mean + sign * sd * cut.mean, lower, upper), sd * sd * cut.variance};
}

MixtureMoments uncertain_half_line(double mean, double sd, double bound, double if_above,
                                   double if_below) {
  SKEIN_CHECK(sd > 0 && if_above >= 0 && if_above <= 1 && if_below >= 0 &&
                  if_below <= 1 && if_above + if_below > 0,
              sd, if_above, if_below);
  const double alpha = (bound - mean) / sd;
  const double above = if_above * normal_upper(alpha);
  const double below = if_below * normal_cdf(alpha);
  const double likelihood = above + below;
  // With a certain reading the tail may underflow; then the other side has weight 0.
  double w = if_above > if_below ? 1 : 0;
  if (likelihood > 0) w = above / likelihood;
  const Moments up = standard_above(alpha), down = standard_above(-alpha);
  const double gap = up.mean + down.mean;  // between the means of the two halves
  return {
      likelihood, mean + sd * (w * up.mean - (1 - w) * down.mean),
      sd * sd * (w * up.variance + (1 - w) * down.variance + w * (1 - w) * gap * gap)};
}

}  // namespace skein::model
