// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"

namespace skein::campaign {

/// One row of a CSV text, with the problems found in it.
class CsvRow {
 public:
  CsvRow(std::string place, std::span<const std::string> columns,
         std::vector<std::string> cells, std::vector<Error>& problems)
      : place_(std::move(place)),
        columns_(columns),
        cells_(std::move(cells)),
        problems_(problems) {}

  /// The cell's text without surrounding blanks; empty when the column does not exist.
  std::string_view text(std::string_view column) const;

  /// A number, "inf" and "-inf" included. An empty cell, other text, nan and finite
  /// numbers beyond +-1e60 are reported, and give no value.
  std::optional<double> number(std::string_view column);
  /// As number(), but an empty cell is no problem.
  std::optional<double> number_if_given(std::string_view column);

  /// Reports a problem in this row; `column` may be empty.
  void report(std::string_view column, const std::string& what);

 private:
  std::string place_;
  std::span<const std::string> columns_;
  std::vector<std::string> cells_;
  std::vector<Error>& problems_;
};

/// Reads comma-separated text with a header line and gives each row to `use`.
///
/// Blank lines, a byte order mark and carriage returns are ignored; cells are not quoted.
/// Problems have `place` "name:line" (the header is line 1) and name the column.
/// @param name      of the text, for messages.
/// @param required  columns that must exist, in any order among others.
/// @returns all problems, those that `use` reports included; after 100 of them reading
///          ends.
std::vector<Error> read_csv(std::istream& in, const std::string& name,
                            std::span<const std::string_view> required,
                            const std::function<void(CsvRow&)>& use);

}  // namespace skein::campaign
