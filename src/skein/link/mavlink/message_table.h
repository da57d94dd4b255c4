// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace skein::mavlink {

/// What is known of a kind of message without its C++ type.
struct MessageEntry {
  static constexpr std::uint8_t kNowhere = 255;

  std::uint32_t id = 0;
  std::string_view name;
  std::uint8_t crc_extra = 0;
  std::uint8_t base_length = 0;  ///< of the payload without extensions [bytes]
  std::uint8_t length = 0;       ///< of the whole payload [bytes]
  /// Where the payload says for whom it is; kNowhere: for everybody.
  std::uint8_t target_system = kNowhere;
  std::uint8_t target_component = kNowhere;
};

/// All of them by rising id.
std::span<const MessageEntry> all_messages();

/// The one of an id; null for an id that the table has not.
const MessageEntry* find_message(std::uint32_t id);

}  // namespace skein::mavlink
