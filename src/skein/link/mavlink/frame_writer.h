// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "skein/link/mavlink/frame.h"
#include "skein/link/mavlink/payload.h"
#include "skein/link/mavlink/signing.h"

namespace skein::mavlink {

/// Writes the frames of one component over one link: each pair has a count of its own,
/// by which the receiver sees what was lost.
class FrameWriter {
 public:
  /// @param version  1 or 2.
  FrameWriter(std::uint8_t system, std::uint8_t component, int version = 2)
      : system_(system), component_(component), version_(version) {}

  std::uint8_t system() const { return system_; }
  std::uint8_t component() const { return component_; }

  /// The next frame, in memory that the next call uses again. Empty for a message that
  /// version 1 cannot say: one with an id above 255.
  template <Message T>
  std::span<const std::byte> write(const T& message) {
    return write(kFacts<T>, kBaseLength<T>, pack(message));
  }

  /// The same signed; version 2 only.
  /// @param now  signing_time() of the clock.
  template <Message T>
  std::span<const std::byte> write(const T& message, Signer& signer, std::uint64_t now) {
    const auto payload = pack(message);
    return write_signed(kFacts<T>, payload, signer, now);
  }

 private:
  std::span<const std::byte> write(const Facts& facts, std::size_t base_length,
                                   std::span<const std::byte> payload);
  std::span<const std::byte> write_signed(const Facts& facts,
                                          std::span<const std::byte> payload,
                                          Signer& signer, std::uint64_t now);
  // Writes a frame of version 2 up to its CRC; returns its length.
  std::size_t write_second(const Facts& facts, std::span<const std::byte> payload,
                           std::uint8_t flags);
  std::size_t end_with_crc(std::size_t length, std::uint8_t crc_extra);

  std::uint8_t system_, component_;
  int version_;
  std::uint8_t sequence_ = 0;
  std::array<std::byte, kMaxFrame> frame_;
};

}  // namespace skein::mavlink
