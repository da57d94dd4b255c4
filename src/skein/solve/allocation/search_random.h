// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/random.h"

namespace skein::solve {

/// Random numbers for searches that draw hundreds of millions: xoshiro256++ (Blackman,
/// Vigna 2019), begun from a stream of (seed, purpose, instance). A search is one
/// sequence, so what a counter-based stream costs would buy nothing.
class SearchRandom {
 public:
  SearchRandom(std::uint64_t seed, std::uint32_t instance) {
    RandomStream stream(seed, 0, Purpose::kAllocation, instance);
    for (std::uint64_t& word : state_) word = stream.bits();
    state_[0] |= 1;  // never all zero
  }

  std::uint64_t bits() {
    const std::uint64_t result = rotated(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotated(state_[3], 45);
    return result;
  }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Uniform in 0 ... n - 1; n from 1 to 2^32.
  std::size_t below(std::size_t n) { return ((bits() >> 32) * n) >> 32; }

 private:
  static std::uint64_t rotated(std::uint64_t x, int k) {
    return (x << k) | (x >> (64 - k));
  }
  std::uint64_t state_[4];
};

}  // namespace skein::solve
