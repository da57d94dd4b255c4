// SPDX-License-Identifier: Apache-2.0
#include "skein/model/probability/normal.h"

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/model/probability/error_function.h"

namespace skein::model {

namespace {

constexpr double kSqrt2 = std::numbers::sqrt2;
constexpr double kSqrtHalfPi = 1.2533141373155002512;

}  // namespace

double erfcx(double x) {
  if (x < 0) {
    const double square = x * x;
    if (x > -cody::kSmall) return math::exp(square) * (1 - cody::erf_small(x));
    return 2 * math::exp(square) - erfcx(-x);
  }
  if (x < cody::kSmall) return math::exp(x * x) * (1 - cody::erf_small(x));
  if (x <= cody::kLarge) {
    const cody::Ratio ratio = cody::erfcx_middle(x);
    return ratio.above / ratio.below;
  }
  return (1 - cody::deficit_large(x)) * std::numbers::inv_sqrtpi / x;
}

double mills_ratio(double x) {
  return kSqrtHalfPi * erfcx(x / kSqrt2);
}

double normal_upper(double x) {
  const double u = x / kSqrt2;
  if (std::abs(u) < cody::kSmall) return 0.5 - 0.5 * cody::erf_small(u);
  const double tail = normal_pdf(x) * mills_ratio(std::abs(x));
  return x > 0 ? tail : 1 - tail;
}

double log_normal_upper(double x) {
  if (x < 0.5) return math::log1p(-normal_upper(-x));
  return -0.5 * x * x + math::log(kInvSqrt2Pi * mills_ratio(x));
}

double gaussian_crps(double mean, double sd, double value) {
  SKEIN_CHECK(sd >= 0, sd);
  if (sd == 0) return std::abs(value - mean);
  const double w = (value - mean) / sd;
  return sd *
         (w * (1 - 2 * normal_upper(w)) + 2 * normal_pdf(w) - std::numbers::inv_sqrtpi);
}

}  // namespace skein::model
