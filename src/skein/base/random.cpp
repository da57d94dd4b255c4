// SPDX-License-Identifier: Apache-2.0
#include "skein/base/random.h"

#include <Random123/philox.h>

#include <bit>
#include <cmath>
#include <numbers>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein {
namespace {

// ln((k + 1/2) / 2^32), within 2e-11. With (k + 1/2) = m 2^e, m in [sqrt(1/2), sqrt(2)):
//   ln m = 2 artanh s = 2 (s + s^3/3 + s^5/5 + ...),  s = (m - 1)/(m + 1), |s| < 0.172
double log_of_fraction(std::uint32_t k) {
  constexpr std::uint64_t kOne = 0x3ff0000000000000;       // bits of 1.0
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd;  // bits of sqrt(1/2)
  constexpr std::uint64_t kMantissa = 0x000fffffffffffff;
  const auto bits = std::bit_cast<std::uint64_t>(static_cast<double>(k) + 0.5);
  const std::uint64_t shifted = bits + (kOne - kRootHalf);
  const double e = static_cast<double>(static_cast<std::int32_t>(shifted >> 52) - 1055);
  const double m = std::bit_cast<double>((shifted & kMantissa) + kRootHalf);
  const double s = (m - 1) / (m + 1), s2 = s * s, s4 = s2 * s2;
  const double series =
      (1.0 + s2 / 3) + s4 * ((1.0 / 5 + s2 / 7) + s4 * (1.0 / 9 + s2 / 11));
  return e * std::numbers::ln2 + 2 * s * series;
}

struct UnitPoint {
  double cos, sin;
};

// One of 2^32 evenly spaced points of the unit circle, within 1e-12. The upper 31 bits
// choose the point of the right half, by its half angle t in (-pi/4, pi/4) and the
// series of sin t and cos t; the lowest bit says whether to mirror it at the origin.
UnitPoint point_on_circle(std::uint32_t k) {
  constexpr double kStep = std::numbers::pi / 4 * 0x1p-30;
  const double t = (static_cast<double>(k >> 1) - (0x1p30 - 0.5)) * kStep;
  const double t2 = t * t, t4 = t2 * t2;
  const double s = t * ((1 - t2 / 6) + t4 * ((1.0 / 120 - t2 / 5040) +
                                             t4 * (1.0 / 362880 - t2 / 39916800)));
  const double c =
      (1 - t2 / 2) +
      t4 * ((1.0 / 24 - t2 / 720) + t4 * ((1.0 / 40320 - t2 / 3628800) + t4 / 479001600));
  const double sign = 1 - 2 * static_cast<double>(k & 1);
  return {sign * (c * c - s * s), sign * (2 * s * c)};
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::uint32_t entity, Purpose purpose,
                           std::uint32_t instance)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      stream_{entity, static_cast<std::uint32_t>(purpose) | instance << 16} {
  SKEIN_CHECK(instance < 1u << 16, instance);
}

std::array<std::uint32_t, 4> RandomStream::next_block() {
  const r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(index_),
                                            static_cast<std::uint32_t>(index_ >> 32),
                                            stream_[0], stream_[1]}};
  const r123::Philox4x32::key_type key{{key_[0], key_[1]}};
  ++index_;
  const auto out = r123::Philox4x32()(counter, key);
  return {out[0], out[1], out[2], out[3]};
}

void RandomStream::refill() {
  const auto out = next_block();
  block_[1] = out[0] | (static_cast<std::uint64_t>(out[1]) << 32);
  block_[0] = out[2] | (static_cast<std::uint64_t>(out[3]) << 32);
  left_ = 2;
}

std::uint64_t RandomStream::bits() {
  if (left_ == 0) refill();
  return block_[static_cast<std::size_t>(--left_)];
}

double RandomStream::uniform() {
  return static_cast<double>(bits() >> 11) * 0x1.0p-53;
}

double RandomStream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  const double radius = std::sqrt(-2 * math::log(1 - uniform()));  // 1 - u is in (0, 1]
  const double angle = 2 * std::numbers::pi * uniform();
  spare_normal_ = radius * math::sin(angle);
  has_spare_ = true;
  return radius * math::cos(angle);
}

std::array<double, 4> RandomStream::normals4() {
  const auto out = next_block();
  std::array<double, 4> normals;
  for (std::size_t i = 0; i < 2; ++i) {
    const double radius = std::sqrt(-2 * log_of_fraction(out[2 * i]));
    const UnitPoint point = point_on_circle(out[2 * i + 1]);
    normals[2 * i] = radius * point.cos;
    normals[2 * i + 1] = radius * point.sin;
  }
  return normals;
}

void RandomStream::seek(std::uint64_t index) {
  index_ = index;
  left_ = 0;
  has_spare_ = false;
}

}  // namespace skein
