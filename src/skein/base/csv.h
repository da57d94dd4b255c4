// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/base/result.h"

/// Comma-separated values, as every command reads them: a header line that names the
/// columns, in any order; a row a line. Cells may stand in quotation marks, commas within
/// them are text; blanks around cells, blank lines, lines that begin with '#', a byte
/// order mark and carriage returns count for nothing; what is no text becomes U+FFFD.
namespace skein {

/// `text` without blanks, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// The number that a cell holds: decimal, in all of the cell, a leading plus allowed,
/// "nan" and "inf" included; none for anything else and for what no double holds.
std::optional<double> number_in(std::string_view cell);

/// Takes the cells of one line, one after the other.
class CsvCells {
 public:
  explicit CsvCells(std::string_view line) : rest_(line) {}

  /// The next cell; none at the line's end. Quotation marks that stand twice within a
  /// cell stay two.
  std::optional<std::string_view> next();

  /// Whether the last cell began with a quotation mark that is not closed on its line.
  bool is_open() const { return is_open_; }

 private:
  std::string_view rest_;
  bool at_end_ = false, is_open_ = false;
};

/// A whole table as text.
class CsvTable {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;  ///< of a file

  /// Fails: as read_file() and parse().
  static Result<CsvTable> load(const std::filesystem::path& file);
  /// @param place  name of the table, for messages.
  /// Fails: kBadInput with the line: no header, a row with another number of cells, a
  ///        quotation mark that is not closed on its line.
  static Result<CsvTable> parse(std::string_view text, const std::string& place);

  std::size_t size() const { return lines_.size(); }  ///< rows
  const std::vector<std::string>& names() const { return names_; }
  /// Index of a column; none when there is none of this name.
  std::optional<std::size_t> column(std::string_view name) const;
  /// Fails: kBadInput: one of `used` stands in the header twice.
  Result<void> check_unique(std::span<const std::string_view> used) const;
  const std::string& text(std::size_t row, std::size_t column) const {
    return cells_[row * names_.size() + column];
  }
  /// A finite number. Fails: kBadInput with file, line and column.
  Result<double> number(std::size_t row, std::size_t column) const;
  /// `file:line` of a row, for messages.
  std::string place(std::size_t row) const;

 private:
  std::string place_;
  std::vector<std::string> names_;
  std::vector<std::string> cells_;   // row by row
  std::vector<std::int64_t> lines_;  // of the rows
};

/// One row of a table, and the problems that are found in it. Columns are asked for by
/// name.
class CsvRow {
 public:
  CsvRow(std::string place, std::span<const std::string> columns,
         std::span<const std::string> cells, std::vector<Error>& problems)
      : place_(std::move(place)), columns_(columns), cells_(cells), problems_(problems) {}

  /// A cell; empty when the table lacks the column.
  std::string_view text(std::string_view column) const;

  /// A number, "inf" and "-inf" included. An empty cell, other text, nan and finite
  /// numbers beyond +-1e60 are reported, and give no value.
  std::optional<double> number(std::string_view column);
  /// As number(), but an empty cell is no problem.
  std::optional<double> number_if_given(std::string_view column);
  /// A number from `min` to `max`; reported where it is none.
  std::optional<double> number(std::string_view column, double min, double max);
  /// A whole number from 0 to `max`, which is at most 2^53; likewise.
  std::optional<std::uint64_t> whole(std::string_view column, std::uint64_t max);

  /// Reports a problem in this row; `column` may be empty.
  void report(std::string_view column, const std::string& what);

 private:
  std::string place_;  // file and line
  std::span<const std::string> columns_;
  std::span<const std::string> cells_;
  std::vector<Error>& problems_;
};

/// Columns of a table. Others may stand in it, and mean nothing.
struct CsvColumns {
  std::span<const std::string_view> required;
  std::span<const std::string_view> optional = {};
};

/// Reads a table and gives each row to `use`.
///
/// Problems have the place "name:line" and name the column.
/// @param text   any bytes.
/// @param place  name of the table, for messages.
/// @returns all problems, those that `use` reports included; after 100 of them reading
///          ends. A table without rows is none; one without a header is.
std::vector<Error> read_csv(std::string_view text, const std::string& place,
                            const CsvColumns& columns,
                            const std::function<void(CsvRow&)>& use);

/// The first of `problems` as an error, with how many more there are; good without any.
Result<void> first_problem(const std::vector<Error>& problems);

}  // namespace skein
