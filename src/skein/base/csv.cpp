// SPDX-License-Identifier: Apache-2.0
#include "skein/base/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "skein/base/input_file.h"
#include "skein/base/valid_text.h"

namespace skein {
namespace {

constexpr double kMaxNumber = 1e60;  // products of four such numbers are still finite
constexpr std::size_t kMaxProblems = 100;
constexpr std::size_t kMaxShown = 40;  // characters of a cell in messages

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

// A cell for messages: short, and printable.
std::string shown_cell(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, kMaxShown)) out += c >= ' ' && c < 127 ? c : '?';
  return text.size() > kMaxShown ? out + "..." : out;
}

std::string unescaped(std::string_view cell) {
  std::string out;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    out += cell[i];
    if (cell[i] == '"' && i + 1 < cell.size() && cell[i + 1] == '"') ++i;
  }
  return out;
}

// The lines that hold cells.
class Lines {
 public:
  explicit Lines(std::string_view text) {
    if (!is_valid_text(text)) {
      replaced_ = valid_text(text);
      text = replaced_;
    }
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    rest_ = text;
  }

  // Puts the cells of the next line behind those of `cells`; their number, 0 at the end.
  // Fails: a quotation mark is not closed.
  Result<std::size_t> next(std::vector<std::string>& cells, const std::string& place) {
    while (!rest_.empty()) {
      const std::size_t feed = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = rest_.substr(0, feed);
      rest_.remove_prefix(std::min(feed + 1, rest_.size()));
      ++number_;
      if (trimmed(line).empty() || line.starts_with('#')) continue;
      std::size_t count = 0;
      CsvCells reader(line);
      for (; const auto cell = reader.next(); ++count) cells.push_back(unescaped(*cell));
      if (reader.is_open())
        return Error{ErrorCode::kBadInput, fmt::format("{}:{}", place, number_),
                     "a quotation mark is not closed on its line.", ""};
      return count;
    }
    return std::size_t{0};
  }

  std::int64_t number() const { return number_; }  // of the line that was given last

 private:
  std::string replaced_;
  std::string_view rest_;
  std::int64_t number_ = 0;
};

Error no_header(const std::string& place, const std::string& hint) {
  return {ErrorCode::kBadInput, place, "the table is empty: it has no header line.",
          hint};
}

Error ragged(const std::string& place, std::size_t cells, std::size_t columns) {
  return {ErrorCode::kBadInput, place,
          fmt::format("{} cells, but the header has {} columns.", cells, columns), ""};
}

Error twice(const std::string& place, std::string_view column) {
  return {ErrorCode::kBadInput, place,
          fmt::format("column \"{}\" occurs twice in the header.", column), ""};
}

std::vector<Error> check_header(const std::vector<std::string>& names,
                                const std::string& place, const CsvColumns& columns) {
  std::vector<Error> problems;
  const auto check = [&](std::string_view column, bool required) {
    const auto count = std::count(names.begin(), names.end(), column);
    if (count > 1) problems.push_back(twice(place, column));
    if (count == 0 && required)
      problems.push_back({ErrorCode::kBadInput, place,
                          fmt::format("column \"{}\" is missing.", column),
                          fmt::format("Needed: {}.", fmt::join(columns.required, ","))});
  };
  for (const std::string_view column : columns.required) check(column, true);
  for (const std::string_view column : columns.optional) check(column, false);
  return problems;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> number_in(std::string_view cell) {
  if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] =
      std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

std::optional<std::string_view> CsvCells::next() {
  if (at_end_) return std::nullopt;
  std::size_t end = 0;
  bool quoted = false;
  for (; end < rest_.size() && (quoted || rest_[end] != ','); ++end)
    if (rest_[end] == '"') quoted = !quoted;
  std::string_view cell = trimmed(rest_.substr(0, end));
  is_open_ = quoted && cell.front() == '"';
  at_end_ = end == rest_.size();
  rest_.remove_prefix(at_end_ ? end : end + 1);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = trimmed(cell.substr(1, cell.size() - 2));
  return cell;
}

Result<CsvTable> CsvTable::load(const std::filesystem::path& file) {
  const auto text = read_file(file, kMaxBytes);
  if (!text) return text.error();
  return parse(text.value(), file.string());
}

Result<CsvTable> CsvTable::parse(std::string_view text, const std::string& place) {
  CsvTable table;
  table.place_ = place;
  Lines lines(text);
  const auto header = lines.next(table.names_, place);
  if (!header) return header.error();
  if (header.value() == 0) return no_header(place, "");
  for (;;) {
    const auto count = lines.next(table.cells_, place);
    if (!count) return count.error();
    if (count.value() == 0) return table;
    table.lines_.push_back(lines.number());
    if (count.value() != table.names_.size())
      return ragged(table.place(table.size() - 1), count.value(), table.names_.size());
  }
}

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (names_[i] == name) return i;
  return std::nullopt;
}

Result<void> CsvTable::check_unique(std::span<const std::string_view> used) const {
  return first_problem(check_header(names_, place_, {{}, used}));
}

Result<double> CsvTable::number(std::size_t row, std::size_t column) const {
  const auto value = number_in(text(row, column));
  if (value && std::isfinite(*value)) return *value;
  return Error{ErrorCode::kBadInput, place(row),
               fmt::format("column \"{}\": \"{}\" is not a finite number.",
                           names_[column], shown_cell(text(row, column))),
               ""};
}

std::string CsvTable::place(std::size_t row) const {
  return fmt::format("{}:{}", place_, lines_[row]);
}

std::string_view CsvRow::text(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return {};
  return cells_[static_cast<std::size_t>(found - columns_.begin())];
}

std::optional<double> CsvRow::number_if_given(std::string_view column) {
  const std::string_view cell = text(column);
  if (cell.empty()) return std::nullopt;
  const auto value = number_in(cell);
  if (!value || std::isnan(*value)) {
    report(column, fmt::format("\"{}\" is not a number.", shown_cell(cell)));
    return std::nullopt;
  }
  if (std::isfinite(*value) && std::abs(*value) > kMaxNumber) {
    report(column, fmt::format("{} is beyond +-{}.", shown_cell(cell), kMaxNumber));
    return std::nullopt;
  }
  return value;
}

std::optional<double> CsvRow::number(std::string_view column) {
  if (text(column).empty()) {
    report(column, "a number is missing.");
    return std::nullopt;
  }
  return number_if_given(column);
}

std::optional<double> CsvRow::number(std::string_view column, double min, double max) {
  const auto value = number_in(text(column));
  if (value && *value >= min && *value <= max) return value;
  report(column, fmt::format("\"{}\" is no number from {} to {}.",
                             shown_cell(text(column)), min, max));
  return std::nullopt;
}

std::optional<std::uint64_t> CsvRow::whole(std::string_view column, std::uint64_t max) {
  const auto value = number_in(text(column));
  if (value && *value >= 0 && *value <= static_cast<double>(max) &&
      *value == std::floor(*value))
    return static_cast<std::uint64_t>(*value);
  report(column, fmt::format("\"{}\" is no whole number from 0 to {}.",
                             shown_cell(text(column)), max));
  return std::nullopt;
}

void CsvRow::report(std::string_view column, const std::string& what) {
  problems_.push_back(
      {ErrorCode::kBadInput, place_,
       column.empty() ? what : fmt::format("column \"{}\": {}", column, what), ""});
}

std::vector<Error> read_csv(std::string_view text, const std::string& place,
                            const CsvColumns& columns,
                            const std::function<void(CsvRow&)>& use) {
  Lines lines(text);
  std::vector<std::string> names, cells;
  const auto header = lines.next(names, place);
  if (!header) return {header.error()};
  if (header.value() == 0)
    return {
        no_header(place, fmt::format("Needed: {}.", fmt::join(columns.required, ",")))};
  std::vector<Error> problems =
      check_header(names, fmt::format("{}:{}", place, lines.number()), columns);
  if (!problems.empty()) return problems;
  for (;;) {
    cells.clear();
    const auto count = lines.next(cells, place);
    if (count && count.value() == 0) return problems;
    std::string here = fmt::format("{}:{}", place, lines.number());
    if (!count) {
      problems.push_back(count.error());
    } else if (count.value() != names.size()) {
      problems.push_back(ragged(here, count.value(), names.size()));
    } else {
      CsvRow row(std::move(here), names, cells, problems);
      use(row);
    }
    if (problems.size() >= kMaxProblems) {
      problems.push_back(
          {ErrorCode::kBadInput, place, "too many problems; not read on.", ""});
      return problems;
    }
  }
}

Result<void> first_problem(const std::vector<Error>& problems) {
  if (problems.empty()) return {};
  Error first = problems.front();
  if (problems.size() > 1)
    first.message += fmt::format(" ({} more.)", problems.size() - 1);
  return first;
}

}  // namespace skein
