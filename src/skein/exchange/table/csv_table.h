// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"

namespace skein::exchange {

/// A column of a table with a header line.
struct CsvColumn {
  std::string_view name;
  bool required = true;
};

/// A row of such a table, and how to say what is wrong with it.
class CsvRow {
 public:
  CsvRow(std::string place, std::span<const CsvColumn> columns,
         std::span<const std::string_view> cells)
      : place_(std::move(place)), columns_(columns), cells_(cells) {}

  /// Cell of a column, in the order of the columns that were asked for; empty when the
  /// table lacks it.
  std::string_view text(std::size_t column) const { return cells_[column]; }

  /// The number in a cell. Fails: it is none from `least` to `most`.
  Result<double> number(std::size_t column, double least, double most) const;
  Result<std::uint64_t> whole(std::size_t column, std::uint64_t most) const;

  Error wrong(std::string message, std::string hint = "") const;

 private:
  std::string place_;  // file and line
  std::span<const CsvColumn> columns_;
  std::span<const std::string_view> cells_;
};

/// Reads a table of comma-separated values whose first line names the columns, in any
/// order; others are ignored, blank lines are no rows.
///
/// @param text   any bytes: what is no text becomes U+FFFD (valid_text.h).
/// @param place  name of the file, for messages.
/// @param take   called for each row; an error of it ends the reading.
/// Fails: kBadInput with the line: a column is missing or there twice, a row has another
///        number of cells, the table is empty, or `take` says so.
Result<void> read_csv_table(std::string_view text, const std::string& place,
                            std::span<const CsvColumn> columns,
                            const std::function<Result<void>(const CsvRow&)>& take);

}  // namespace skein::exchange
