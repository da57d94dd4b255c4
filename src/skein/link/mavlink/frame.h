// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "skein/link/mavlink/message_table.h"

namespace skein::mavlink {

inline constexpr std::uint8_t kMagic1 = 0xfe;  ///< first byte of a frame of version 1
inline constexpr std::uint8_t kMagic2 = 0xfd;
inline constexpr std::size_t kHeader1 = 6;   ///< bytes before the payload, version 1
inline constexpr std::size_t kHeader2 = 10;  ///< the same, version 2
inline constexpr std::size_t kCrcLength = 2;
inline constexpr std::size_t kSignatureLength = 13;
inline constexpr std::uint8_t kSignedFlag = 0x01;  ///< of the incompatible flags
inline constexpr std::size_t kMaxFrame = 280;

/// A frame as it was received; its bytes belong to whoever handed it out.
struct Frame {
  std::span<const std::byte> bytes;  ///< from the magic to CRC or signature
  /// Null for a kind that is not known here: its CRC could not be checked, so it is only
  /// good for passing on.
  const MessageEntry* message = nullptr;

  std::uint8_t at(std::size_t place) const {
    return static_cast<std::uint8_t>(bytes[place]);
  }
  int version() const { return at(0) == kMagic1 ? 1 : 2; }
  bool is_signed() const { return version() == 2 && (at(2) & kSignedFlag) != 0; }
  std::uint8_t sequence() const { return at(version() == 1 ? 2 : 4); }
  std::uint8_t system() const { return at(version() == 1 ? 3 : 5); }
  std::uint8_t component() const { return at(version() == 1 ? 4 : 6); }
  std::uint32_t id() const {
    if (version() == 1) return at(5);
    return at(7) | static_cast<std::uint32_t>(at(8) << 8) |
           static_cast<std::uint32_t>(at(9) << 16);
  }
  std::span<const std::byte> payload() const {
    return bytes.subspan(version() == 1 ? kHeader1 : kHeader2, at(1));
  }
  /// The system that it is for; 0: all, also of a kind without one.
  std::uint8_t target_system() const {
    return message ? payload_at(message->target_system) : std::uint8_t{0};
  }
  /// The component that it is for; 0: all.
  std::uint8_t target_component() const {
    return message ? payload_at(message->target_component) : std::uint8_t{0};
  }

 private:
  // What a short payload lacks is 0.
  std::uint8_t payload_at(std::uint8_t place) const {
    const auto there = payload();
    return place < there.size() ? static_cast<std::uint8_t>(there[place])
                                : std::uint8_t{0};
  }
};

}  // namespace skein::mavlink
