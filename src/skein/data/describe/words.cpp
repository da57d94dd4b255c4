// SPDX-License-Identifier: Apache-2.0
#include "skein/data/describe/words.h"

#include <algorithm>
#include <charconv>

namespace skein::words {

std::vector<std::string_view> split(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r\n";
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return words;
    const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

std::optional<double> number(std::string_view word) {
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

std::optional<Vec2> place(std::string_view word) {
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto north = number(word.substr(0, comma)), east = number(word.substr(comma + 1));
  if (!north || !east) return std::nullopt;
  return Vec2(*north, *east);
}

}  // namespace skein::words
