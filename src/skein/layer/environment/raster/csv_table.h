// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"

namespace skein::environment {

/// A small comma-separated table with a header line, as text.
///
/// Fields may stand in double quotes; spaces around fields, empty lines and lines that
/// start with '#' are skipped; both line ends and a byte-order mark are understood.
class CsvTable {
 public:
  /// Fails: kNotFound, kBadInput: no such file, no header, a row with another number of
  ///        fields than the header, an open quote, more than 64 MB.
  static Result<CsvTable> load(const std::string& path);
  static Result<CsvTable> parse(std::string_view text, const std::string& place);

  std::size_t size() const { return rows_.size(); }
  const std::vector<std::string>& names() const { return names_; }
  /// Index of a column; none when there is none of this name.
  std::optional<std::size_t> column(std::string_view name) const;
  const std::string& text(std::size_t row, std::size_t column) const {
    return rows_[row].fields[column];
  }
  /// A finite number. Fails: kBadInput naming file, line and column.
  Result<double> number(std::size_t row, std::size_t column) const;
  /// `file:line` of a row, for messages.
  std::string place(std::size_t row) const;

 private:
  struct Row {
    int line;
    std::vector<std::string> fields;
  };
  std::string path_;
  std::vector<std::string> names_;
  std::vector<Row> rows_;
};

/// The finite number that all of `text` is; none otherwise.
std::optional<double> parse_number(std::string_view text);

}  // namespace skein::environment
