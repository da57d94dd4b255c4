// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"

namespace skein::exchange {

/// Answers a table of connections row by row: what `skein plan connect --batch` does.
///
/// In, comma separated with a header line: x0, y0, psi0, x1, y1, psi1, airspeed,
/// turn_radius, wx, wy in any order; x east, y north [m], psi of the air-relative
/// velocity counter-clockwise from east [rad], wx, wy the wind's velocity to east and
/// north [m/s]. Other columns are ignored, blank lines are no rows.
///
/// Out: time_s, word, length_m (over ground), status; one row for each row, in their
/// order. Words are as seen on a map: L is counter-clockwise. Numbers are the shortest
/// that read as the same double. Status is model::name_of(ConnectionStatus), or
/// "unreadable" for a row with too few or too many cells or a cell that is no number;
/// unless it is "found", the other three cells are empty. Numbers beyond 1e70, airspeeds
/// and radii below 1e-70 and goals beyond 1e9 turn radii are "bad-input".
///
/// Holds one row, however long the table is.
class ConnectionBatch {
 public:
  /// @param name  of the table, for messages.
  explicit ConnectionBatch(std::string name);

  /// Takes the next part of the table, cut anywhere, and adds the answers to `out`.
  /// Fails: kBadInput when the header lacks a column or has it twice; nothing more can
  ///        be taken then.
  Result<void> take(std::string_view part, std::string& out);

  /// Takes the end of the table: a last line without a line feed counts.
  /// Fails: as take(); a table without a header.
  Result<void> finish(std::string& out);

  std::int64_t rows() const { return rows_; }
  std::int64_t unsolved() const { return unsolved_; }  ///< rows that are not "found"

 private:
  Result<void> take_line(std::string_view line, std::string& out);
  Result<void> read_header(std::string_view line);
  void answer(std::string_view line, std::string& out);

  std::string name_;
  std::string begun_;         // a line whose end has not come yet
  bool too_long_ = false;     // the line in begun_ is
  std::vector<int> meaning_;  // of each column: an index of kColumns, or -1
  std::int64_t line_ = 0, rows_ = 0, unsolved_ = 0;
};

}  // namespace skein::exchange
