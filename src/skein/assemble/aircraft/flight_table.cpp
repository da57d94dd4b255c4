// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/aircraft/flight_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/csv.h"
#include "skein/scenario/numbers.h"
#include "skein/scenario/text.h"

namespace skein::assemble {
namespace {

constexpr std::size_t kLongestLine = 1 << 20;  // bytes; rows of real tables have some 500

struct Bounds {
  std::string_view column;
  double low, high;
  std::string_view hint;
};

// Wide enough for every flight that the models cover; what lies outside is a slip.
constexpr std::string_view kInDegrees = "Angles are in radians.";
constexpr double kAny = std::numeric_limits<double>::max();
constexpr Bounds kBounds[] = {
    {"t", -1e9, 1e9, ""},
    {"de_rad", -1.6, 1.6, kInDegrees},
    {"da_rad", -1.6, 1.6, kInDegrees},
    {"dr_rad", -1.6, 1.6, kInDegrees},
    {"thrust_N", -1e6, 1e6, ""},
    {"wind_n_mps", -200, 200, ""},
    {"wind_e_mps", -200, 200, ""},
    {"wind_d_mps", -200, 200, ""},
    {"north_m", -1e7, 1e7, ""},
    {"east_m", -1e7, 1e7, ""},
    {"down_m", -11000, 1000, "Down is minus the altitude above mean sea level."},
    {"u_mps", -1000, 1000, ""},
    {"v_mps", -1000, 1000, ""},
    {"w_mps", -1000, 1000, ""},
    {"phi_rad", -kAny, kAny, ""},
    {"theta_rad", -kAny, kAny, ""},
    {"psi_rad", -kAny, kAny, ""},
    {"p_rps", -100, 100, ""},
    {"q_rps", -100, 100, ""},
    {"r_rps", -100, 100, ""},
};
static_assert(std::size(kBounds) == kInputColumns.size() + kStateColumns.size());

bool is_column(std::string_view name) {
  return std::any_of(std::begin(kBounds), std::end(kBounds),
                     [&](const Bounds& each) { return each.column == name; });
}

// A cell for messages.
std::string shown(std::string_view cell) {
  return scenario::first_bad_byte(cell) ? "bytes that are no text"
                                        : scenario::quote(cell);
}

}  // namespace

FlightTableReader::FlightTableReader(std::istream& in, std::string name)
    : in_(in), name_(std::move(name)), buffer_(kLongestLine) {}

Error FlightTableReader::error(std::string_view column, std::string message,
                               std::string hint) const {
  std::string place = fmt::format("{}:{}", name_, line_);
  if (!column.empty()) place += fmt::format(":{}", column);
  return {ErrorCode::kBadInput, std::move(place), std::move(message), std::move(hint)};
}

// Puts the next line that is not empty into cells_.
Result<bool> FlightTableReader::read_line() {
  while (true) {
    in_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    const std::streamsize got = in_.gcount();  // with the line feed, if there is one
    if (in_.bad())
      return Error{ErrorCode::kUnavailable, name_, "cannot be read to its end.", ""};
    if (got == 0) return false;
    ++line_;
    if (in_.fail() && !in_.eof())
      return error("", fmt::format("a line of more than {} bytes.", kLongestLine - 1));
    const auto length = static_cast<std::size_t>(in_.eof() ? got : got - 1);
    std::string_view line(buffer_.data(), length);
    if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    if (trimmed(line).empty()) continue;
    cells_.clear();
    CsvCells cells(line);
    while (const auto cell = cells.next()) cells_.push_back(*cell);
    return true;
  }
}

Result<void> FlightTableReader::read_header() {
  const Result<bool> header = read_line();
  if (!header) return header.error();
  if (!header.value())
    return Error{ErrorCode::kBadInput, name_, "the table is empty.",
                 "Its first line names the columns: t, de_rad, ..."};
  std::string missing, twice, hint;
  std::vector<std::string> others;  // columns that mean nothing here: slips, perhaps
  for (const std::string_view cell : cells_)
    if (!scenario::first_bad_byte(cell) && !is_column(cell)) others.emplace_back(cell);
  for (const Bounds& each : kBounds) {
    const auto found = std::find(cells_.begin(), cells_.end(), each.column);
    if (found == cells_.end()) {
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", each.column);
      const std::string near = scenario::nearest_name(each.column, others);
      if (hint.empty() && !near.empty())
        hint = fmt::format("Is {} the column {}?", scenario::quote(near), each.column);
      continue;
    }
    if (std::find(found + 1, cells_.end(), each.column) != cells_.end())
      twice += fmt::format("{}{}", twice.empty() ? "" : ", ", each.column);
    columns_.push_back({each.column, static_cast<std::size_t>(found - cells_.begin())});
  }
  std::string message;
  if (!missing.empty()) message = fmt::format("the header lacks: {}.", missing);
  if (!twice.empty())
    message += fmt::format("{}given twice: {}.", message.empty() ? "" : " ", twice);
  if (!message.empty()) return error("", std::move(message), std::move(hint));
  return {};
}

Result<double> FlightTableReader::value(const Column& column) {
  if (column.index >= cells_.size())
    return error(column.name, fmt::format("is missing: the row has {} value{}.",
                                          cells_.size(), cells_.size() == 1 ? "" : "s"));
  const std::string_view cell = cells_[column.index];
  if (cell.empty()) return error(column.name, "is empty; needs a number.");
  const auto number = scenario::parse_number(cell);
  if (!number || !std::isfinite(*number))
    return error(column.name, fmt::format("found {}; needs a number.", shown(cell)));
  const Bounds& bounds = kBounds[static_cast<std::size_t>(&column - columns_.data())];
  if (*number < bounds.low || *number > bounds.high)
    return error(column.name,
                 fmt::format("found {}; must be from {:.6g} to {:.6g}.", cell, bounds.low,
                             bounds.high),
                 std::string(bounds.hint));
  return *number;
}

Result<FlightInput> FlightTableReader::input() {
  FlightInput row;
  double* const into[] = {&row.t,      &row.elevator,   &row.aileron,    &row.rudder,
                          &row.thrust, &row.wind_N.x(), &row.wind_N.y(), &row.wind_N.z()};
  for (std::size_t i = 0; i < kInputColumns.size(); ++i) {
    const Result<double> number = value(columns_[i]);
    if (!number) return number.error();
    *into[i] = number.value();
  }
  return row;
}

Result<void> FlightTableReader::read_start() {
  double* const into[] = {
      &start_.p_N.x(),       &start_.p_N.y(),        &start_.p_N.z(),
      &start_.v_B.x(),       &start_.v_B.y(),        &start_.v_B.z(),
      &start_.attitude.roll, &start_.attitude.pitch, &start_.attitude.yaw,
      &start_.w_NB_B.x(),    &start_.w_NB_B.y(),     &start_.w_NB_B.z()};
  for (std::size_t i = 0; i < kStateColumns.size(); ++i) {
    const Result<double> number = value(columns_[kInputColumns.size() + i]);
    if (!number) return number.error();
    *into[i] = number.value();
  }
  geo::Euler& attitude = start_.attitude;
  for (double* angle : {&attitude.roll, &attitude.pitch, &attitude.yaw})
    *angle = geo::wrap_pi(*angle);
  return {};
}

Result<FlightInput> FlightTableReader::first() {
  if (const auto header = read_header(); !header) return header.error();
  const Result<bool> any = read_line();
  if (!any) return any.error();
  if (!any.value())
    return Error{ErrorCode::kBadInput, name_, "the table has no rows.",
                 "Its first row also holds the initial state."};
  const Result<FlightInput> row = input();
  if (!row) return row.error();
  if (const auto state = read_start(); !state) return state.error();
  last_t_ = row.value().t;
  return row;
}

Result<std::optional<FlightInput>> FlightTableReader::next() {
  const Result<bool> any = read_line();
  if (!any) return any.error();
  if (!any.value()) return std::optional<FlightInput>();
  const Result<FlightInput> row = input();
  if (!row) return row.error();
  if (row.value().t <= last_t_)
    return error("t", fmt::format("found {}; must be above {}, that of the row before.",
                                  row.value().t, last_t_));
  last_t_ = row.value().t;
  return std::optional<FlightInput>(row.value());
}

}  // namespace skein::assemble
