#include "skein/layer/communication/medium/error_model.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::communication {
namespace {

constexpr double kHeaderRate = 1e6;  // [bit/s]
// Above this not one bit of a thousand frames fails.
constexpr double kClear = 12;
constexpr double kLost = -700;  // of a logarithm: for certain

double log_success(double bit_error, double bits) {
  if (bit_error >= 0.5) bit_error = 0.5;
  return std::max(kLost, bits * math::log1p(-bit_error));
}

}  // namespace

double ErrorRates::log_header_success(double signal_to_noise, double duration) const {
  if (model == ErrorModel::kThreshold) return signal_to_noise < least_ratio ? kLost : 0;
  if (signal_to_noise > kClear) return 0;
  return log_success(0.5 * math::exp(-22 * signal_to_noise), kHeaderRate * duration);
}

double ErrorRates::log_payload_success(double signal_to_noise, double duration) const {
  if (model == ErrorModel::kThreshold) return signal_to_noise < least_ratio ? kLost : 0;
  if (signal_to_noise > kClear) return 0;
  // (sqrt(2) + 1) / sqrt(8 pi sqrt(2)) and 2 - sqrt(2).
  constexpr double kFactor = 0.40494706590575064, kSlope = 0.5857864376269049;
  const double x = 11 * signal_to_noise;
  const double bit_error = x > 0 ? kFactor / std::sqrt(x) * math::exp(-kSlope * x) : 0.5;
  return log_success(bit_error, rate * duration);
}

}  // namespace skein::communication
