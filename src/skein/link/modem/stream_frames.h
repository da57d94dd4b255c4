// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace skein::modem {

/// Check sequence of a frame: CRC-16 with x^16 + x^12 + x^5 + 1, begun with all ones.
/// Reference: [ITU-T V.42] 8.1.1.6.1, without its complement and reflection.
std::uint16_t check_sequence(std::span<const std::byte> bytes);

/// A datagram as it goes over a serial line or a connection:
///
///   "SK"  length  check sequence of the length  datagram  check sequence of all but "SK"
///
/// Numbers are little-endian, of 2 bytes. The head has a check of its own, so that a
/// damaged length is known at once, not after as many bytes as it says.
/// Fails: Bug for more than kMaxDatagram bytes.
std::vector<std::byte> in_frame(std::span<const std::byte> datagram);

/// Takes datagrams out of what comes over a serial line or a connection. Where bytes are
/// damaged it goes on at the next frame; where some are missing, when as many have come.
/// Holds no more than one frame and what came at once.
class StreamFrames {
 public:
  /// Calls handle(bytes) for each datagram that is complete and sound.
  template <class Handle>
  void read(std::span<const std::byte> bytes, Handle&& handle) {
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    std::size_t at = 0;
    for (;;) {
      const std::span<const std::byte> rest =
          std::span<const std::byte>(waiting_).subspan(at);
      const Found found = look(rest);
      if (found.skip == 0) break;
      if (found.length > 0) handle(rest.subspan(kHead, found.length));
      at += found.skip;
    }
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  /// Heads and datagrams whose check sequence was wrong.
  std::uint64_t damaged() const { return damaged_; }

 private:
  static constexpr std::size_t kHead = 6, kTail = 2;
  struct Found {
    std::size_t skip = 0;    // bytes that are done with; 0: more are needed
    std::size_t length = 0;  // of a datagram at the beginning; 0: there is none
  };
  Found look(std::span<const std::byte> bytes);
  Found damaged_frame();

  std::vector<std::byte> waiting_;
  std::uint64_t damaged_ = 0;
};

}  // namespace skein::modem
