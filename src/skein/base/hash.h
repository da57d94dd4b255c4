// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace skein {

/// A running 128-bit fingerprint (XXH3) of what was put in, in that order. Not
/// cryptographic: it distinguishes equal runs from different ones.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  void add(std::span<const std::byte> bytes);
  void add(std::string_view text);
  void add(std::int64_t number);
  /// By value, not by bytes: -0 counts as 0 and every NaN as one.
  void add(double number);

  /// The fingerprint of all so far: 32 hexadecimal digits.
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace skein
