// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/csv_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>

namespace skein::campaign {

namespace {

constexpr double kLargest = 1e60;  // products of four such numbers are still finite
constexpr std::size_t kMaxProblems = 100;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

// Cells in messages: short, and printable.
std::string shown(std::string_view text) {
  std::string out;
  for (char c : text.substr(0, 40)) out += c >= ' ' && c < 127 ? c : '?';
  return text.size() > 40 ? out + "..." : out;
}

// The header's columns; problems when it cannot serve.
std::vector<std::string> read_header(std::string_view line, const std::string& name,
                                     std::span<const std::string_view> required,
                                     std::vector<Error>& problems) {
  if (line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
  std::vector<std::string> columns = split(line);
  for (std::string_view requested : required)
    if (std::find(columns.begin(), columns.end(), requested) == columns.end())
      problems.push_back({ErrorCode::kBadInput, name + ":1",
                          fmt::format("column \"{}\" is missing", requested),
                          fmt::format("needed: {}", fmt::join(required, ","))});
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (std::count(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(i),
                   columns[i]) == 1)
      problems.push_back({ErrorCode::kBadInput, name + ":1",
                          fmt::format("column \"{}\" occurs twice", shown(columns[i])),
                          ""});
  return columns;
}

}  // namespace

std::string_view CsvRow::text(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return {};
  return cells_[static_cast<std::size_t>(found - columns_.begin())];
}

std::optional<double> CsvRow::number_if_given(std::string_view column) {
  const std::string_view cell = text(column);
  if (cell.empty()) return std::nullopt;
  const std::string_view digits = cell.front() == '+' ? cell.substr(1) : cell;
  double value = 0;
  const auto [end, code] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = code == std::errc() && end == digits.data() + digits.size();
  if (!whole || std::isnan(value)) {
    report(column, fmt::format("\"{}\" is not a number", shown(cell)));
    return std::nullopt;
  }
  if (std::isfinite(value) && std::abs(value) > kLargest) {
    report(column, fmt::format("{} is beyond +-{}", shown(cell), kLargest));
    return std::nullopt;
  }
  return value;
}

std::optional<double> CsvRow::number(std::string_view column) {
  if (text(column).empty()) {
    report(column, "a number is missing");
    return std::nullopt;
  }
  return number_if_given(column);
}

void CsvRow::report(std::string_view column, const std::string& what) {
  problems_.push_back(
      {ErrorCode::kBadInput, place_,
       column.empty() ? what : fmt::format("column \"{}\": {}", column, what), ""});
}

std::vector<Error> read_csv(std::istream& in, const std::string& name,
                            std::span<const std::string_view> required,
                            const std::function<void(CsvRow&)>& use) {
  std::vector<Error> problems;
  std::string line;
  if (!std::getline(in, line) || trimmed(line).empty())
    return {{ErrorCode::kBadInput, name + ":1", "the header line is missing",
             fmt::format("needed: {}", fmt::join(required, ","))}};
  const std::vector<std::string> columns = read_header(line, name, required, problems);
  if (!problems.empty()) return problems;
  for (int number = 2; std::getline(in, line); ++number) {
    if (trimmed(line).empty()) continue;
    std::vector<std::string> cells = split(line);
    const std::string place = fmt::format("{}:{}", name, number);
    if (cells.size() != columns.size()) {
      problems.push_back({ErrorCode::kBadInput, place,
                          fmt::format("{} cells, but the header has {} columns",
                                      cells.size(), columns.size()),
                          ""});
    } else {
      CsvRow row(place, columns, std::move(cells), problems);
      use(row);
    }
    if (problems.size() >= kMaxProblems) {
      problems.push_back(
          {ErrorCode::kBadInput, name, "too many problems; not read on", ""});
      break;
    }
  }
  if (in.bad()) problems.push_back({ErrorCode::kUnavailable, name, "reading failed", ""});
  return problems;
}

}  // namespace skein::campaign
