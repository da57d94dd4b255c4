// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "skein/data/describe/wire.h"

namespace skein::reasoning {

/// A number that equal values have in common, and different ones hardly ever (FNV-1a of
/// the canonical bytes). Any member computes the same.
template <class T>
std::uint64_t fingerprint(const T& value) {
  std::vector<std::byte> bytes;
  wire::encode_canonical(value, bytes);
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::byte byte : bytes)
    hash = (hash ^ static_cast<std::uint64_t>(byte)) * 1099511628211ULL;
  return hash;
}

/// The same in 32 bits.
template <class T>
std::uint32_t short_fingerprint(const T& value) {
  const std::uint64_t hash = fingerprint(value);
  return static_cast<std::uint32_t>(hash ^ (hash >> 32));
}

}  // namespace skein::reasoning
