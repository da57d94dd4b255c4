// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/update.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace skein::scenario {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

// Where `rename.from` begins in its line; npos when it does not stand there. A name may
// be in quotation marks.
std::size_t offset_in(const std::string& line, const Rename& rename) {
  if (rename.place.column < 1) return std::string::npos;
  auto at = static_cast<std::size_t>(rename.place.column - 1);
  if (at < line.size() && (line[at] == '"' || line[at] == '\'')) ++at;
  return at < line.size() && line.compare(at, rename.from.size(), rename.from) == 0
             ? at
             : std::string::npos;
}

}  // namespace

Result<std::string> with_new_names(std::string_view text, const std::string& name,
                                   std::span<const Rename> renames) {
  std::vector<std::string> lines = lines_of(text);
  std::vector<Rename> order(renames.begin(), renames.end());
  // From the end, so that places in front of a change stay right; a name that is read by
  // way of several aliases was found as often.
  std::ranges::stable_sort(order, std::ranges::greater(), &Rename::place);
  Place last;
  for (const Rename& rename : order) {
    if (rename.place == last) continue;
    last = rename.place;
    const auto line = static_cast<std::size_t>(rename.place.line - 1);
    const std::size_t at =
        line < lines.size() ? offset_in(lines[line], rename) : std::string::npos;
    if (at == std::string::npos)
      return Error{ErrorCode::kBadInput,
                   fmt::format("{}:{}:{}", name, rename.place.line, rename.place.column),
                   fmt::format("\"{}\" does not stand here.", rename.from),
                   "Was the file changed meanwhile?"};
    lines[line].replace(at, rename.from.size(), rename.to);
  }
  std::string updated;
  for (const std::string& line : lines) updated += line;
  return updated;
}

std::string changed_lines(std::string_view before, std::string_view after) {
  const auto old_lines = lines_of(before), new_lines = lines_of(after);
  std::string text;
  const auto show = [&](char sign, std::string_view line) {
    text += sign;
    text += line;
    if (!line.ends_with('\n')) text += '\n';
  };
  for (std::size_t k = 0; k < std::min(old_lines.size(), new_lines.size()); ++k) {
    if (old_lines[k] == new_lines[k]) continue;
    text += fmt::format("@@ line {} @@\n", k + 1);
    show('-', old_lines[k]);
    show('+', new_lines[k]);
  }
  return text;
}

}  // namespace skein::scenario
