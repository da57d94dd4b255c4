// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace skein::mavlink {

/// What the definitions say of a kind of message, besides its fields.
struct Facts {
  std::uint32_t id = 0;
  std::string_view name;
  std::uint8_t crc_extra = 0;   ///< a short hash of the base fields' names and types
  std::size_t base_fields = 0;  ///< the fields after these are extensions
};

}  // namespace skein::mavlink
