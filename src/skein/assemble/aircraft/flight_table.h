// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

namespace skein::assemble {

/// What acts on a fixed wing that flies open loop, at one moment.
struct FlightInput {
  double t = 0;                ///< [s]
  double elevator = 0;         ///< deflection, trailing edge down positive [rad]
  double aileron = 0;          ///< rolls right positive [rad]
  double rudder = 0;           ///< yaws left positive [rad]
  double thrust = 0;           ///< along the forward axis [N]
  Vec3 wind_N = Vec3::Zero();  ///< [m/s]
};

/// How such a flight begins, in the words of its table.
struct FlightStart {
  Vec3 p_N = Vec3::Zero();     ///< [m]
  Vec3 v_B = Vec3::Zero();     ///< over ground, in components of B [m/s]
  geo::Euler attitude;         ///< [rad]
  Vec3 w_NB_B = Vec3::Zero();  ///< [rad/s]
};

/// The columns of inputs, then those of the state, as tables name them.
inline constexpr std::array<std::string_view, 8> kInputColumns = {
    "t",        "de_rad",     "da_rad",     "dr_rad",
    "thrust_N", "wind_n_mps", "wind_e_mps", "wind_d_mps"};
inline constexpr std::array<std::string_view, 12> kStateColumns = {
    "north_m", "east_m",    "down_m",  "u_mps", "v_mps", "w_mps",
    "phi_rad", "theta_rad", "psi_rad", "p_rps", "q_rps", "r_rps"};

/// Reads a table of inputs, comma separated, a row at a time: docs/fly.md describes it.
/// Holds one row, however long the table is.
class FlightTableReader {
 public:
  /// @param in    outlives the reader.
  /// @param name  what messages call it.
  FlightTableReader(std::istream& in, std::string name);

  /// Reads the header and the first row. Call once, first.
  ///
  /// Fails: a column missing or given twice, no row, a value that is no number or out of
  ///        its range; all that is wrong with the header at once.
  Result<FlightInput> first();

  /// The next row; none at the end. Only the input columns are looked at.
  ///
  /// Fails: a value missing, no number or out of its range, t not above the row before.
  Result<std::optional<FlightInput>> next();

  /// The state columns of the first row.
  const FlightStart& start() const { return start_; }
  const std::string& name() const { return name_; }
  /// Of the row read last, from 1.
  std::size_t line() const { return line_; }

 private:
  struct Column {
    std::string_view name;
    std::size_t index = 0;  // among the cells of a row
  };

  Result<bool> read_line();  // false at the end
  Result<void> read_header();
  Result<double> value(const Column& column);
  Result<FlightInput> input();
  Result<void> read_start();
  Error error(std::string_view column, std::string message, std::string hint = {}) const;

  std::istream& in_;
  std::string name_;
  std::vector<char> buffer_;
  std::vector<std::string_view> cells_;  // of the line in buffer_
  std::vector<Column> columns_;          // inputs, then states
  std::size_t line_ = 0;
  double last_t_ = 0;
  FlightStart start_;
};

}  // namespace skein::assemble
