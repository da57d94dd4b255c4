// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "skein/base/shown_text.h"

namespace skein::scenario {
namespace {

// The character at `i` as a message may hold it; `i` goes on to the next one.
std::string next_shown(std::string_view text, std::size_t& i) {
  const std::size_t begin = i;
  i += std::max<std::size_t>(1, utf8_length(text.substr(i)));
  const auto c = static_cast<unsigned char>(text[begin]);
  if (c == '\n') return "\\n";
  if (c < 0x20 || c == 0x7F) return fmt::format("\\x{:02x}", c);
  return std::string(text.substr(begin, i - begin));
}

// Of a byte of UTF-8: it does not begin a character.
bool is_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace

std::optional<std::size_t> first_bad_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    if ((c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F) return i;
    const std::size_t length = utf8_length(text.substr(i));
    if (length == 0) return i;
    i += length;
  }
  return std::nullopt;
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest_name(std::string_view word, std::span<const std::string> names) {
  constexpr std::size_t kLongestWord = 80;
  if (word.empty() || word.size() > kLongestWord) return {};
  std::string best;
  int best_distance = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  for (const std::string& name : names) {
    const int distance = edit_distance(word, name);
    if (distance < best_distance) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

std::string quote(std::string_view text) {
  constexpr std::size_t kMax = 60;
  std::string shown;
  for (std::size_t i = 0; i < text.size() && shown.size() < kMax;) {
    shown += next_shown(text, i);
    if (shown.size() >= kMax && i < text.size()) shown += "...";
  }
  return '"' + shown + '"';
}

std::string quote_path(std::string_view path) {
  constexpr std::size_t kMax = 300;
  const bool whole = path.size() <= kMax;
  std::size_t i = whole ? 0 : path.size() - kMax;
  while (i < path.size() && is_continuation(path[i])) ++i;
  std::string shown = whole ? "" : "...";
  while (i < path.size()) shown += next_shown(path, i);
  return '"' + shown + '"';
}

std::string any_of(std::span<const std::string> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace skein::scenario
