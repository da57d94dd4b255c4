// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace skein::mavlink {

/// CRC-16/MCRF4XX, as frames end with: polynomial 0x1021 reflected, begins with 0xffff.
class Crc {
 public:
  void add(std::uint8_t byte) {
    value_ = static_cast<std::uint16_t>((value_ >> 8) ^ kTable[(value_ ^ byte) & 0xff]);
  }
  void add(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) add(static_cast<std::uint8_t>(byte));
  }
  std::uint16_t value() const { return value_; }

 private:
  static constexpr std::array<std::uint16_t, 256> kTable = [] {
    std::array<std::uint16_t, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      auto value = static_cast<std::uint16_t>(i);
      for (int bit = 0; bit < 8; ++bit)
        value = static_cast<std::uint16_t>((value >> 1) ^ (value & 1 ? 0x8408 : 0));
      table[i] = value;
    }
    return table;
  }();

  std::uint16_t value_ = 0xffff;
};

}  // namespace skein::mavlink
