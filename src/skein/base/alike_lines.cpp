// SPDX-License-Identifier: Apache-2.0
#include "skein/base/alike_lines.h"

#include <map>
#include <utility>

namespace skein {
namespace {

constexpr std::size_t kMaxAlike = 3;  // lines that are left as they are

// A line without its numbers.
std::string shape_of(const std::string& line) {
  std::string shape;
  bool in_number = false;
  for (const char c : line) {
    if (c >= '0' && c <= '9') {
      if (!in_number) shape += '#';
      in_number = true;
    } else if (!in_number || c != '.') {
      shape += c;
      in_number = false;
    }
  }
  return shape;
}

}  // namespace

void join_alike_lines(std::vector<std::string>& lines, std::size_t first) {
  std::map<std::string, std::size_t> count;
  for (std::size_t i = first; i < lines.size(); ++i) ++count[shape_of(lines[i])];
  std::vector<std::string> kept;
  for (std::size_t i = first; i < lines.size(); ++i) {
    std::size_t& alike = count[shape_of(lines[i])];
    if (alike == 0) continue;
    if (alike <= kMaxAlike) {
      kept.push_back(std::move(lines[i]));
      continue;
    }
    kept.push_back(lines[i] + " (and " + std::to_string(alike - 1) + " more like it)");
    alike = 0;
  }
  lines.resize(first);
  for (std::string& line : kept) lines.push_back(std::move(line));
}

}  // namespace skein
