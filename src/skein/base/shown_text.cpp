// SPDX-License-Identifier: Apache-2.0
#include "skein/base/shown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace skein {
namespace {

// Characters above U+007F that are not shown as they are: from, to.
constexpr std::array<std::pair<char32_t, char32_t>, 8> kHidden = {{{0x0080, 0x009F},
                                                                   {0x061C, 0x061C},
                                                                   {0x200B, 0x200B},
                                                                   {0x200E, 0x200F},
                                                                   {0x2028, 0x202E},
                                                                   {0x2066, 0x2069},
                                                                   {0xFEFF, 0xFEFF},
                                                                   {0xE0000, 0xE007F}}};

bool is_hidden(char32_t c) {
  return std::any_of(kHidden.begin(), kHidden.end(), [&](const auto& range) {
    return c >= range.first && c <= range.second;
  });
}

// The character of a whole sequence of two to four bytes.
char32_t decoded(std::string_view sequence) {
  const auto lead = static_cast<unsigned char>(sequence[0]);
  char32_t c = lead & (0xFFU >> (sequence.size() + 1));
  for (const char next : sequence.substr(1))
    c = c << 6 | (static_cast<unsigned char>(next) & 0x3FU);
  return c;
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const unsigned char second = byte(1);
  if (lead == 0xE0 && second < 0xA0) return 0;
  if (lead == 0xED && second > 0x9F) return 0;
  if (lead == 0xF0 && second < 0x90) return 0;
  if (lead == 0xF4 && second > 0x8F) return 0;
  return length;
}

std::string shown(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const auto byte = static_cast<unsigned char>(text[0]);
    if (length > 1) {
      const char32_t c = decoded(text.substr(0, length));
      if (is_hidden(c))
        out += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(c));
      else
        out += text.substr(0, length);
    } else if (length == 1 &&
               ((byte >= 0x20 && byte != 0x7F) || byte == '\n' || byte == '\t')) {
      out += text[0];
    } else {
      out += fmt::format("\\x{:02x}", byte);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace skein
