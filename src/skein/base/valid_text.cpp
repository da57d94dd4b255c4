// SPDX-License-Identifier: Apache-2.0
#include "skein/base/valid_text.h"

#include <cstdint>
#include <cstring>
#include <utility>

#include "skein/base/shown_text.h"

namespace skein {
namespace {

constexpr std::uint64_t kHighBits = 0x8080808080808080;
constexpr std::uint64_t kOnes = 0x0101010101010101;

// Whether eight bytes are ASCII other than NUL.
bool is_plain_ascii(const char* bytes) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  return (word & kHighBits) == 0 && ((word - kOnes) & ~word & kHighBits) == 0;
}

// Bytes of the valid text that `text` begins with.
std::size_t valid_length(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    if (text.size() - i >= sizeof(std::uint64_t) && is_plain_ascii(text.data() + i)) {
      i += sizeof(std::uint64_t);
      continue;
    }
    const std::size_t length = text[i] == '\0' ? 0 : utf8_length(text.substr(i));
    if (length == 0) return i;
    i += length;
  }
  return i;
}

}  // namespace

bool is_valid_text(std::string_view text) {
  return valid_length(text) == text.size();
}

std::string valid_text(std::string text) {
  std::string_view rest = text;
  std::size_t good = valid_length(rest);
  if (good == rest.size()) return text;
  std::string out;
  out.reserve(text.size() + kReplacement.size());
  for (; good < rest.size(); good = valid_length(rest)) {
    out.append(rest.substr(0, good)).append(kReplacement);
    rest.remove_prefix(good + 1);
  }
  return out.append(rest);
}

}  // namespace skein
