// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "skein/link/mavlink/frame.h"

namespace skein::mavlink {

/// What has come in over a link, since its begin.
struct ParserCounts {
  std::uint64_t frames = 0;         ///< good ones, with those of unknown kinds
  std::uint64_t unknown = 0;        ///< of kinds that the table has not
  std::uint64_t bad_crc = 0;        ///< looked like a frame until their end
  std::uint64_t incompatible = 0;   ///< need what this program does not know
  std::uint64_t skipped_bytes = 0;  ///< that belonged to no frame
};

/// Finds frames in a stream of bytes, however it is cut into pieces.
///
/// Whatever comes in, it needs no more memory than its own; after bytes that are no
/// frame it looks for the next from one byte after the false begin on.
class FrameParser {
 public:
  /// Reads what has come, and calls take(const Frame&) for each whole frame. The frame's
  /// bytes are gone when the call returns.
  template <class Take>
  void read(std::span<const std::byte> bytes, Take&& take) {
    while (!bytes.empty()) {
      bytes = bytes.subspan(fill(bytes));
      while (const std::optional<Frame> frame = next()) take(*frame);
    }
  }

  const ParserCounts& counts() const { return counts_; }

 private:
  // Takes as many bytes as there is room for; returns how many.
  std::size_t fill(std::span<const std::byte> bytes);
  // The next whole frame in what is held.
  std::optional<Frame> next();
  void skip(std::size_t bytes);

  std::array<std::byte, 2048> held_;
  std::size_t begin_ = 0, end_ = 0;  // of what is not read yet
  ParserCounts counts_;
};

}  // namespace skein::mavlink
