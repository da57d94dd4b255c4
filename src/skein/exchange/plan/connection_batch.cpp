// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/connection_batch.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>

#include "skein/base/csv.h"
#include "skein/model/connection/connection.h"
#include "skein/model/path/flight_plan.h"

namespace skein::exchange {
namespace {

using model::Connection;
using model::ConnectionStatus;

enum Column { kX0, kY0, kPsi0, kX1, kY1, kPsi1, kAirspeed, kRadius, kWx, kWy, kCount };
constexpr std::array<std::string_view, kCount> kColumns = {
    "x0", "y0", "psi0", "x1", "y1", "psi1", "airspeed", "turn_radius", "wx", "wy"};
using Values = std::array<double, kCount>;

constexpr std::size_t kLongestLine = 1 << 20;  // bytes; rows of real tables have some 200
constexpr std::string_view kUnreadable = "unreadable";
constexpr std::string_view kHeader = "time_s,word,length_m,status\n";

// The solver's words turn right towards growing angles from its first axis to its second.
// With east as the first and north as the second axis, angles need no conversion, which
// would round them; the picture is mirrored, and left is right.
std::string_view as_on_map(model::DubinsWord word) {
  constexpr std::array<std::string_view, 6> kMirrored = {"RSR", "RSL", "LSR",
                                                         "LSL", "RLR", "LRL"};
  return kMirrored[static_cast<std::size_t>(word)];
}

// Beyond these the squares of ratios that solving takes are no numbers any more.
constexpr double kLargest = 1e70, kSmallest = 1e-70;

bool within_reach(const Values& values) {
  for (const double v : values)
    if (!(std::abs(v) <= kLargest)) return false;
  return values[kAirspeed] >= kSmallest && values[kRadius] >= kSmallest;
}

bool read_values(std::string_view line, const std::vector<int>& meaning, Values& values) {
  CsvCells cells(line);
  for (const int column : meaning) {
    const auto cell = cells.next();
    if (!cell) return false;
    if (column < 0) continue;
    const auto value = number_in(*cell);
    if (!value) return false;
    values[static_cast<std::size_t>(column)] = *value;
  }
  return !cells.next();
}

}  // namespace

ConnectionBatch::ConnectionBatch(std::string name) : name_(std::move(name)) {}

Result<void> ConnectionBatch::take(std::string_view part, std::string& out) {
  while (!part.empty()) {
    const void* const feed = std::memchr(part.data(), '\n', part.size());
    const std::size_t length =
        feed ? static_cast<std::size_t>(static_cast<const char*>(feed) - part.data())
             : part.size();
    const std::string_view piece = part.substr(0, length);
    part.remove_prefix(feed ? length + 1 : length);
    if (feed && begun_.empty() && !too_long_) {
      if (auto good = take_line(piece, out); !good) return good;
      continue;
    }
    too_long_ = too_long_ || begun_.size() + piece.size() > kLongestLine;
    if (!too_long_) begun_ += piece;
    if (!feed) break;
    if (auto good = take_line(begun_, out); !good) return good;
    begun_.clear();
    too_long_ = false;
  }
  return {};
}

Result<void> ConnectionBatch::finish(std::string& out) {
  if (!begun_.empty() || too_long_)
    if (auto good = take_line(begun_, out); !good) return good;
  if (meaning_.empty())
    return Error{ErrorCode::kBadInput, name_, "the table is empty.",
                 "Its first line names the columns: x0,y0,psi0,x1,y1,psi1,airspeed,"
                 "turn_radius,wx,wy."};
  return {};
}

Result<void> ConnectionBatch::take_line(std::string_view line, std::string& out) {
  ++line_;
  if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  if (!too_long_ && trimmed(line).empty()) return {};
  if (!meaning_.empty()) {
    answer(line, out);
    return {};
  }
  if (auto good = read_header(line); !good) return good;
  out += kHeader;
  return {};
}

Result<void> ConnectionBatch::read_header(std::string_view line) {
  const std::string place = fmt::format("{}:{}", name_, line_);
  if (too_long_)
    return Error{ErrorCode::kBadInput, place,
                 fmt::format("a header of more than {} bytes.", kLongestLine), ""};
  std::array<int, kCount> times{};
  CsvCells cells(line);
  while (const auto cell = cells.next()) {
    int meaning = -1;
    for (int i = 0; i < kCount; ++i)
      if (*cell == kColumns[static_cast<std::size_t>(i)]) meaning = i;
    if (meaning >= 0) ++times[static_cast<std::size_t>(meaning)];
    meaning_.push_back(meaning);
  }
  std::string missing, twice;
  for (std::size_t i = 0; i < kCount; ++i) {
    std::string* const list = times[i] == 0 ? &missing : times[i] > 1 ? &twice : nullptr;
    if (list) *list += fmt::format("{}{}", list->empty() ? "" : ", ", kColumns[i]);
  }
  if (!missing.empty())
    return Error{ErrorCode::kBadInput, place,
                 fmt::format("the header lacks: {}.", missing),
                 "x is east, y north [m], psi counter-clockwise from east [rad]."};
  if (!twice.empty())
    return Error{ErrorCode::kBadInput, place, fmt::format("given twice: {}.", twice), ""};
  return {};
}

void ConnectionBatch::answer(std::string_view line, std::string& out) {
  ++rows_;
  Values v{};
  std::string_view status = kUnreadable;
  if (!too_long_ && read_values(line, meaning_, v)) {
    const model::Pose from{{v[kX0], v[kY0]}, v[kPsi0]};
    const model::Pose to{{v[kX1], v[kY1]}, v[kPsi1]};
    const model::AirMotion air{v[kAirspeed], v[kRadius], {v[kWx], v[kWy]}};
    const Connection found =
        within_reach(v) ? model::connect(from, to, air) : Connection{};
    status = model::name_of(found.status);
    if (found.status == ConnectionStatus::kFound) {
      const double length = model::ground_length(model::to_flight_plan(found, from, air));
      fmt::format_to(std::back_inserter(out), FMT_COMPILE("{},{},{},{}\n"), found.time,
                     as_on_map(found.word), length, status);
      return;
    }
  }
  ++unsolved_;
  fmt::format_to(std::back_inserter(out), FMT_COMPILE(",,,{}\n"), status);
}

}  // namespace skein::exchange
