// SPDX-License-Identifier: Apache-2.0
#include "skein/data/describe/wire.h"

namespace skein::wire {
namespace detail {

bool Reader::get_varint(std::uint64_t& value) {
  value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    std::uint8_t byte = 0;
    if (!get_raw(byte)) return false;
    const std::uint64_t bits = byte & 0x7FU;
    if (shift == 63 && bits > 1) return fail("an integer is too large");
    value |= bits << shift;
    if ((byte & 0x80U) == 0) return true;
  }
  return fail("an integer is too long");
}

bool Reader::get_part(Reader& part) {
  std::uint64_t size = 0;
  if (!get_varint(size)) return false;
  if (size > bytes_.size()) return fail("it ends too early");
  part.bytes_ = bytes_.first(static_cast<std::size_t>(size));
  bytes_ = bytes_.subspan(static_cast<std::size_t>(size));
  return true;
}

}  // namespace detail

Error bad_bytes(const char* wrong) {
  return Error{ErrorCode::kBadInput, "",
               std::string("these bytes are no value: ") + wrong, ""};
}

}  // namespace skein::wire
