// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/table/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/base/valid_text.h"
#include "skein/exchange/table/csv_cells.h"

namespace skein::exchange {
namespace {

std::string names_of(std::span<const CsvColumn> columns) {
  std::string names;
  for (const CsvColumn& column : columns)
    names += fmt::format(
        "{}{}", names.empty() ? "" : ",",
        column.required ? std::string(column.name) : fmt::format("[{}]", column.name));
  return names;
}

std::string_view shown_cell(std::string_view cell) {
  return cell.empty() ? "nothing" : cell;
}

// What stands in each cell of a row: the place of its column, or the number of columns.
Result<std::vector<std::size_t>> read_column_names(std::string_view line,
                                                   const std::string& place,
                                                   std::span<const CsvColumn> columns) {
  const std::string hint =
      fmt::format("Its first line names the columns: {}.", names_of(columns));
  std::vector<std::size_t> meaning;
  std::vector<int> times(columns.size());
  CsvCells cells(line);
  while (const auto cell = cells.next()) {
    const auto at = std::find_if(columns.begin(), columns.end(),
                                 [&](const CsvColumn& c) { return c.name == *cell; });
    const auto column = static_cast<std::size_t>(at - columns.begin());
    if (column < columns.size()) ++times[column];
    meaning.push_back(column);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (times[i] == 0 && columns[i].required)
      return Error{ErrorCode::kBadInput, place,
                   fmt::format("the header lacks {}.", columns[i].name), hint};
    if (times[i] > 1)
      return Error{ErrorCode::kBadInput, place,
                   fmt::format("the header has {} twice.", columns[i].name), hint};
  }
  return meaning;
}

}  // namespace

Error CsvRow::wrong(std::string message, std::string hint) const {
  return {ErrorCode::kBadInput, place_, std::move(message), std::move(hint)};
}

Result<double> CsvRow::number(std::size_t column, double least, double most) const {
  const auto value = number_in(cells_[column]);
  if (!value || !(*value >= least && *value <= most))
    return wrong(fmt::format("{}: {} is no number from {} to {}.", columns_[column].name,
                             shown_cell(cells_[column]), least, most));
  return *value;
}

Result<std::uint64_t> CsvRow::whole(std::size_t column, std::uint64_t most) const {
  const auto value = number_in(cells_[column]);
  if (!value || !(*value >= 0 && *value <= static_cast<double>(most)) ||
      *value != std::floor(*value))
    return wrong(fmt::format("{}: {} is no whole number from 0 to {}.",
                             columns_[column].name, shown_cell(cells_[column]), most));
  return static_cast<std::uint64_t>(*value);
}

Result<void> read_csv_table(std::string_view text, const std::string& place,
                            std::span<const CsvColumn> columns,
                            const std::function<Result<void>(const CsvRow&)>& take) {
  std::string replaced;
  if (!is_valid_text(text)) {
    replaced = valid_text(text);
    text = replaced;
  }
  std::vector<std::size_t> meaning;
  std::vector<std::string_view> cells(columns.size());
  bool has_header = false;
  for (std::int64_t line_number = 1; !text.empty(); ++line_number) {
    const std::size_t feed = text.find('\n');
    std::string_view line = text.substr(0, feed);
    text.remove_prefix(feed == std::string_view::npos ? text.size() : feed + 1);
    if (line_number == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    if (trimmed(line).empty()) continue;
    const std::string here = fmt::format("{}:{}", place, line_number);
    if (!has_header) {
      auto read = read_column_names(line, here, columns);
      if (!read) return read.error();
      meaning = std::move(read.value());
      has_header = true;
      continue;
    }
    std::fill(cells.begin(), cells.end(), std::string_view());
    std::size_t count = 0;
    CsvCells reader(line);
    while (const auto cell = reader.next()) {
      if (count < meaning.size() && meaning[count] < cells.size())
        cells[meaning[count]] = *cell;
      ++count;
    }
    const CsvRow row(here, columns, cells);
    if (count != meaning.size())
      return row.wrong(
          fmt::format("{} cells; the header has {}.", count, meaning.size()));
    if (auto good = take(row); !good) return good.error();
  }
  if (has_header) return {};
  return Error{ErrorCode::kBadInput, place, "the table is empty.",
               fmt::format("Its first line names the columns: {}.", names_of(columns))};
}

}  // namespace skein::exchange
