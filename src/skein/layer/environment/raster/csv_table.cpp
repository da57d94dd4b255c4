// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/csv_table.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "skein/base/input_file.h"

namespace skein::environment {
namespace {

constexpr std::size_t kMaxBytes = 64u << 20;  // of a table

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

// The fields of one line; none when a quote stays open.
std::optional<std::vector<std::string>> split(std::string_view line) {
  std::vector<std::string> fields;
  std::string field;
  bool quoted = false, was_quoted = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i == line.size() || (line[i] == ',' && !quoted)) {
      if (quoted) return std::nullopt;
      fields.push_back(was_quoted ? field : trimmed(field));
      field.clear();
      was_quoted = false;
    } else if (line[i] == '"') {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"') {
        field += '"';
        ++i;
      } else {
        if (!quoted) field.clear();
        quoted = !quoted;
        was_quoted = true;
      }
    } else if (quoted || !was_quoted) {
      field += line[i];
    }
  }
  return fields;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<CsvTable> CsvTable::load(const std::string& path) {
  const auto text = read_file(path, kMaxBytes);
  if (!text) return text.error();
  return parse(text.value(), path);
}

Result<CsvTable> CsvTable::parse(std::string_view text, const std::string& place) {
  CsvTable table;
  table.path_ = place;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view content = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (content.ends_with('\r')) content.remove_suffix(1);
    if (trimmed(content).empty() || content.starts_with('#')) continue;
    auto fields = split(content);
    if (!fields)
      return Error{ErrorCode::kBadInput, fmt::format("{}:{}", place, line),
                   "a quotation mark is not closed on its line", ""};
    if (table.names_.empty()) {
      table.names_ = std::move(*fields);
    } else if (fields->size() != table.names_.size()) {
      return Error{ErrorCode::kBadInput, fmt::format("{}:{}", place, line),
                   fmt::format("has {} fields, the header has {}", fields->size(),
                               table.names_.size()),
                   ""};
    } else {
      table.rows_.push_back({line, std::move(*fields)});
    }
  }
  if (table.names_.empty())
    return Error{ErrorCode::kBadInput, place, "has no header line", ""};
  return table;
}

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (names_[i] == name) return i;
  return std::nullopt;
}

Result<double> CsvTable::number(std::size_t row, std::size_t column) const {
  if (const auto value = parse_number(text(row, column))) return *value;
  return Error{ErrorCode::kBadInput, place(row),
               fmt::format("column {}: \"{}\" is not a finite number", names_[column],
                           text(row, column)),
               ""};
}

std::string CsvTable::place(std::size_t row) const {
  return fmt::format("{}:{}", path_, rows_[row].line);
}

}  // namespace skein::environment
