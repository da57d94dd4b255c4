// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace skein::exchange {

/// `text` without blanks, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// Takes the first cell off a line of comma-separated values; none when the line is at
/// its end. A cell may be in quotation marks, commas within them are text; quotation
/// marks written twice stay two.
class CsvCells {
 public:
  explicit CsvCells(std::string_view line) : rest_(line) {}
  std::optional<std::string_view> next();

 private:
  std::string_view rest_;
  bool at_end_ = false;
};

/// The number that a cell holds: decimal, in all of the cell, a leading plus allowed,
/// "nan" and "inf" included; none for anything else and for what no double holds.
std::optional<double> number_in(std::string_view cell);

}  // namespace skein::exchange
