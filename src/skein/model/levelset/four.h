// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

// Four numbers at once, and the functions of <cmath> and <algorithm> that are used on
// them. Each lane is what the same function makes of one float, to the last bit, so that
// code may go on with single ones where there are fewer than four.

namespace skein::model {

using Four [[gnu::vector_size(16)]] = float;
using FourBits [[gnu::vector_size(16)]] = std::int32_t;  // -1 where something is true
inline constexpr std::size_t kLanes = 4;

template <class V>
inline V load(const float* from) {
  V value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <class V>
inline void store(float* to, const V& value) {
  std::memcpy(to, &value, sizeof value);
}

inline Four four_of(float value) {
  return Four{value, value, value, value};
}

inline bool any(FourBits lanes) {
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(lanes);
  return (halves[0] | halves[1]) != 0;
}

inline bool all(FourBits lanes) {
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(lanes);
  return (halves[0] & halves[1]) == std::numeric_limits<std::uint64_t>::max();
}

template <class V>
inline V minimum(V a, V b) {
  return b < a ? b : a;
}

template <class V>
inline V maximum(V a, V b) {
  return a < b ? b : a;
}

inline float with_sign_of(float size, float sign) {
  return std::copysign(size, sign);
}
inline Four with_sign_of(Four size, Four sign) {
  constexpr std::int32_t kSign = std::numeric_limits<std::int32_t>::min();
  return std::bit_cast<Four>((std::bit_cast<FourBits>(size) & ~kSign) |
                             (std::bit_cast<FourBits>(sign) & kSign));
}

template <class V>
inline V absolute(V x) {
  return with_sign_of(x, V{});
}

inline float root(float x) {
  return std::sqrt(x);
}
inline Four root(Four x) {
#if defined(__SSE__)
  return _mm_sqrt_ps(x);
#else
  for (std::size_t k = 0; k < kLanes; ++k) x[k] = std::sqrt(x[k]);
  return x;
#endif
}

}  // namespace skein::model
