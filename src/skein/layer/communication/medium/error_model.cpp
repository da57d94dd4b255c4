// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/error_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/math.h"
#include "skein/geo/vec.h"

namespace skein::communication {
namespace {

constexpr double kHeaderRate = 1e6;    // [bit/s]
constexpr double kWordRate = 1.375e6;  // [1/s]
// Above this not one bit of a thousand frames fails.
constexpr double kClear = 12;
constexpr double kLost = -700;  // of a logarithm: for certain

double log_success(double bit_error, double bits) {
  if (bit_error >= 0.5) bit_error = 0.5;
  return std::max(kLost, bits * math::log1p(-bit_error));
}

double log_dbpsk_success(double sinr, double duration) {
  if (sinr > kClear) return 0;
  return log_success(0.5 * math::exp(-22 * sinr), kHeaderRate * duration);
}

// Logarithms of P over b = sqrt(2 e).
class WordErrors {
 public:
  WordErrors() {
    for (std::size_t k = 0; k < logs_.size(); ++k)
      logs_[k] = math::log(integral(static_cast<double>(k) / kSteps));
  }

  double at(double b) const {
    if (b >= kMax) return 0;
    const double place = b * kSteps;
    const auto k = static_cast<std::size_t>(place);
    return math::exp(logs_[k] +
                     (place - static_cast<double>(k)) * (logs_[k + 1] - logs_[k]));
  }

 private:
  static constexpr int kSteps = 32, kMax = 10;

  // 1 - (2 Phi(x + b) - 1)^7, times phi(x).
  static double integrand(double x, double b) {
    const double beyond = math::erfc((x + b) / std::sqrt(2.0));
    return -math::expm1(7 * math::log1p(-beyond)) * math::exp(-x * x / 2) /
           std::sqrt(2 * geo::kPi);
  }

  // By Simpson's rule, and what lies below -b.
  static double integral(double b) {
    constexpr double kEnd = 8;
    constexpr int kPieces = 200;
    const double step = (kEnd + b) / kPieces;
    // At -b the bracket is 1.
    double sum = math::exp(-b * b / 2) / std::sqrt(2 * geo::kPi) + integrand(kEnd, b);
    for (int k = 1; k < kPieces; ++k)
      sum += (k % 2 == 0 ? 2 : 4) * integrand(-b + k * step, b);
    return sum * step / 3 + 0.5 * math::erfc(b / std::sqrt(2.0));
  }

  std::array<double, kMax * kSteps + 1> logs_;
};

}  // namespace

double ThresholdErrors::log_header_success(double sinr, double) const {
  return sinr < least_ratio_ ? kLost : 0;
}
double ThresholdErrors::log_payload_success(double sinr, double) const {
  return sinr < least_ratio_ ? kLost : 0;
}

double Dsss1::log_header_success(double sinr, double duration) const {
  return log_dbpsk_success(sinr, duration);
}
double Dsss1::log_payload_success(double sinr, double duration) const {
  return log_dbpsk_success(sinr, duration);
}

double Dsss2::log_header_success(double sinr, double duration) const {
  return log_dbpsk_success(sinr, duration);
}
double Dsss2::log_payload_success(double sinr, double duration) const {
  if (sinr > kClear) return 0;
  // (sqrt(2) + 1) / sqrt(8 pi sqrt(2)) and 2 - sqrt(2).
  constexpr double kFactor = 0.40494706590575064, kSlope = 0.5857864376269049;
  const double x = 11 * sinr;
  const double bit_error = x > 0 ? kFactor / std::sqrt(x) * math::exp(-kSlope * x) : 0.5;
  return log_success(bit_error, rate_ * duration);
}

double Cck::word_error(double e) {
  static const WordErrors errors;
  return errors.at(std::sqrt(2 * e));
}
double Cck::log_header_success(double sinr, double duration) const {
  return log_dbpsk_success(sinr, duration);
}
double Cck::log_payload_success(double sinr, double duration) const {
  const bool one = bits_ == Bits::kFour;
  const double error = word_error(one ? 8 * sinr : 4 * sinr);
  return std::max(kLost, (one ? 1 : 2) * kWordRate * duration * math::log1p(-error));
}

double NoncoherentFsk::log_header_success(double sinr, double duration) const {
  return log_payload_success(sinr, duration);
}
double NoncoherentFsk::log_payload_success(double sinr, double duration) const {
  return log_success(0.5 * math::exp(-sinr * spread_ / 2), rate_ * duration);
}

}  // namespace skein::communication
