// SPDX-License-Identifier: Apache-2.0
#include "skein/model/front/wavelet.h"

#include <algorithm>

#include <fmt/format.h>

#include "skein/base/math.h"

namespace skein::model {
namespace {

constexpr double kMaxLengthToBreadth = 8;  // as [Finney98]: longer ellipses are not seen
constexpr double kMaxWind = 60;  // [m/s], beyond any wind a fire has been seen in
constexpr double kMaxSlope = geo::radians(45);
constexpr double kMaxDoublings = 60;  // far above the bound on wind, far below overflow

}  // namespace

Result<void> check(const SpreadLaw& law) {
  const auto bad = [](const char* name, double value, const char* allowed) {
    return Error{ErrorCode::kBadInput, name, fmt::format("{} must be {}", value, allowed),
                 ""};
  };
  if (!(std::isfinite(law.rate) && law.rate >= 0))
    return bad("rate", law.rate, "0 or above");
  if (!(std::isfinite(law.wind_reduction) && law.wind_reduction >= 0))
    return bad("wind_reduction", law.wind_reduction, "0 or above");
  if (!(std::isfinite(law.wind_response) && law.wind_response > 0))
    return bad("wind_response", law.wind_response, "above 0");
  if (!(std::isfinite(law.slope_doubling) && law.slope_doubling >= 0))
    return bad("slope_doubling", law.slope_doubling, "0 or above");
  return {};
}

double length_to_breadth(double wind) {
  const double u = std::min(wind, kMaxWind);
  const double ratio =
      0.936 * math::exp(0.2566 * u) + 0.461 * math::exp(-0.1548 * u) - 0.397;
  return std::clamp(ratio, 1.0, kMaxLengthToBreadth);
}

Wavelet spread_wavelet(const SpreadLaw& law, const Vec2& wind, const Vec2& gradient,
                       double fuel) {
  Wavelet w;
  const double base = law.rate * fuel;
  if (!(base > 0)) return w;

  Vec2 phi = law.wind_response * law.wind_reduction * wind;
  const double steepness2 = gradient.squaredNorm();
  if (steepness2 > 0 && law.slope_doubling > 0) {
    const double steepness = std::sqrt(steepness2);
    const double angle = std::min(math::atan(steepness), kMaxSlope);
    const double doublings = std::min(angle / law.slope_doubling, kMaxDoublings);
    phi += (math::exp2(doublings) - 1) / steepness * gradient;
  }
  const double size = phi.norm();
  if (size > 0) w.heading = phi / size;
  const double gain = std::min(size, kMaxWind * law.wind_response);

  const double head = base * (1 + gain);
  const double lb = length_to_breadth(gain / law.wind_response);
  const double root = std::sqrt(lb * lb - 1);
  const double back = head * (lb - root) / (lb + root);
  w.length = (head + back) / 2;
  w.width = w.length / lb;
  w.drift = (head - back) / 2;
  return w;
}

}  // namespace skein::model
