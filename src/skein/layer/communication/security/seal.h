// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace skein::communication {

/// The secret that a team shares.
using TeamKey = std::array<std::byte, 32>;

/// Seals messages, so that whoever has the same key knows that they are authentic:
///
///   content | counter, 8 bytes, little-endian | tag = BLAKE2b-128(key; counter |
///   content)
///
/// The content is not secret. Never the same counter twice from one sender.
///
/// Cost: a microsecond for each kilobyte or so; no allocation but of what is sealed.
/// Reference: RFC 7693, BLAKE2b with a key; libsodium's `crypto_generichash`.
class Seal {
 public:
  static constexpr std::size_t kCounterBytes = 8, kTagBytes = 16;
  static constexpr std::size_t kBytes = kCounterBytes + kTagBytes;

  explicit Seal(const TeamKey& key);
  ~Seal();  // forgets the key
  Seal(const Seal&) = delete;
  Seal& operator=(const Seal&) = delete;

  /// Appends counter and tag to what `message` holds.
  void put_on(std::vector<std::byte>& message, std::uint64_t counter) const;

  /// @param sealed  any bytes
  /// @returns       the counter, if the tag is that of this key; else nothing
  std::optional<std::uint64_t> counter_of(std::span<const std::byte> sealed) const;

 private:
  using Tag = std::array<unsigned char, kTagBytes>;
  Tag tag_of(std::uint64_t counter, std::span<const std::byte> content) const;

  TeamKey key_;
};

}  // namespace skein::communication
