// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/traffic/encounters.h"
#include "skein/base/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace skein::exchange {
namespace {

using model::WellClearConfiguration;

enum EncounterColumn {
  kOfCase,
  kOfAircraft,
  kOfAlerter,
  kOfNorth,
  kOfEast,
  kOfDown,
  kOfVn,
  kOfVe,
  kOfVd,
  kEncounterColumns
};
constexpr std::array<std::string_view, kEncounterColumns> kEncounterNames = {
    "case",   "aircraft", "alerter", "north_m", "east_m",
    "down_m", "vn_mps",   "ve_mps",  "vd_mps"};
using EncounterCells = std::array<std::string_view, kEncounterColumns>;

constexpr double kMaxPlace = 1e7;       // [m]
constexpr double kMaxPlaceSpeed = 1e4;  // [m/s]
constexpr int kMaxIntruderNumber = 1'000'000;

class EncounterReader {
 public:
  EncounterReader(std::string place, const WellClearConfiguration& configuration)
      : place_(std::move(place)), configuration_(configuration) {}

  Result<void> take_line(std::string_view line) {
    ++line_;
    if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    if (trimmed(line).empty()) return {};
    return meaning_.empty() ? read_header(line) : read_row(line);
  }

  Result<std::vector<Encounter>> finish() {
    if (meaning_.empty()) return wrong("the table is empty.", columns_hint());
    if (auto good = close(); !good) return good.error();
    return std::move(encounters_);
  }

 private:
  Error wrong(std::string message, std::string hint = "") const {
    return {ErrorCode::kBadInput, fmt::format("{}:{}", place_, line_), std::move(message),
            std::move(hint)};
  }
  static std::string columns_hint() {
    return fmt::format("Its first line names the columns: {}.",
                       fmt::join(kEncounterNames, ","));
  }

  Result<void> read_header(std::string_view line) {
    std::array<int, kEncounterColumns> times{};
    CsvCells cells(line);
    while (const auto cell = cells.next()) {
      const auto at = std::find(kEncounterNames.begin(), kEncounterNames.end(), *cell);
      const auto column = static_cast<std::size_t>(at - kEncounterNames.begin());
      if (column < kEncounterColumns) ++times[column];
      meaning_.push_back(column);
    }
    for (std::size_t i = 0; i < kEncounterColumns; ++i) {
      if (times[i] == 0)
        return wrong(fmt::format("the header lacks {}.", kEncounterNames[i]),
                     columns_hint());
      if (times[i] > 1)
        return wrong(fmt::format("the header has {} twice.", kEncounterNames[i]));
    }
    return {};
  }

  Result<void> read_row(std::string_view line) {
    EncounterCells cells{};
    CsvCells reader(line);
    std::size_t count = 0;
    while (const auto cell = reader.next()) {
      if (count < meaning_.size() && meaning_[count] < kEncounterColumns)
        cells[meaning_[count]] = *cell;
      ++count;
    }
    if (count != meaning_.size())
      return wrong(fmt::format("{} cells; the header has {}.", count, meaning_.size()));
    if (cells[kOfCase].empty()) return wrong("case is empty.");
    if (cells[kOfCase].find_first_of(",\"") != std::string_view::npos)
      return wrong("case: commas and quotation marks are not allowed.");
    if (encounters_.empty() || encounters_.back().name != cells[kOfCase])
      if (auto good = begin(cells[kOfCase]); !good) return good;
    return add_aircraft(cells);
  }

  Result<void> begin(std::string_view name) {
    if (auto good = close(); !good) return good;
    if (!names_.emplace(name).second)
      return wrong(fmt::format("case {} is there already.", name),
                   "The rows of a case stand together.");
    encounters_.push_back({std::string(name), {}, {}, {}});
    has_own_ = false;
    return {};
  }

  // Whether the case that ends is whole.
  Result<void> close() const {
    if (encounters_.empty() || has_own_) return {};
    return wrong(
        fmt::format("case {} has no aircraft 0, the own one.", encounters_.back().name));
  }

  Result<void> add_aircraft(const EncounterCells& cells) {
    Encounter& encounter = encounters_.back();
    const auto number = number_in(cells[kOfAircraft]);
    if (!number || !(*number >= 0 && *number <= kMaxIntruderNumber) ||
        *number != std::floor(*number))
      return wrong(fmt::format("aircraft: {} is no whole number from 0 to {}.",
                               cells[kOfAircraft], kMaxIntruderNumber));
    const auto motion = read_motion(cells);
    if (!motion) return motion.error();
    if (*number == 0) {
      if (has_own_)
        return wrong(fmt::format("case {} has two aircraft 0.", encounter.name));
      has_own_ = true;
      encounter.own = motion.value();
      return {};
    }
    const int n = static_cast<int>(*number);
    if (std::find(encounter.numbers.begin(), encounter.numbers.end(), n) !=
        encounter.numbers.end())
      return wrong(fmt::format("case {} has two aircraft {}.", encounter.name, n));
    const auto alerter = alerter_named(configuration_, cells[kOfAlerter]);
    if (!alerter)
      return wrong(fmt::format("alerter: {} is none of configuration {}.",
                               cells[kOfAlerter], configuration_.name),
                   alerters_hint());
    encounter.numbers.push_back(n);
    encounter.intruders.push_back({motion.value(), *alerter, 0, 0});
    return {};
  }

  Result<model::AircraftMotion> read_motion(const EncounterCells& cells) const {
    std::array<double, kEncounterColumns> values{};
    for (std::size_t i = kOfNorth; i < kEncounterColumns; ++i) {
      const double limit = i >= kOfVn ? kMaxPlaceSpeed : kMaxPlace;
      const auto value = number_in(cells[i]);
      if (!value || !(std::abs(*value) <= limit))
        return wrong(fmt::format("{}: {} is no number from {} to {}.", kEncounterNames[i],
                                 cells[i].empty() ? "nothing" : cells[i], -limit, limit));
      values[i] = *value;
    }
    return model::AircraftMotion{Vec3(values[kOfNorth], values[kOfEast], values[kOfDown]),
                                 Vec3(values[kOfVn], values[kOfVe], values[kOfVd])};
  }

  std::string alerters_hint() const {
    std::string names;
    for (const model::Alerter& alerter : configuration_.alerters)
      names += (names.empty() ? "" : ", ") + alerter.name;
    return fmt::format("It has {}.", names);
  }

  std::string place_;
  const WellClearConfiguration& configuration_;
  std::vector<std::size_t> meaning_;  // of each column; kEncounterColumns: none
  std::int64_t line_ = 0;
  bool has_own_ = false;
  std::set<std::string, std::less<>> names_;
  std::vector<Encounter> encounters_;
};

}  // namespace

Result<std::vector<Encounter>> read_encounters(
    std::string_view text, const std::string& place,
    const WellClearConfiguration& configuration) {
  EncounterReader reader(place, configuration);
  while (!text.empty()) {
    const std::size_t feed = text.find('\n');
    if (auto good = reader.take_line(text.substr(0, feed)); !good) return good.error();
    text.remove_prefix(feed == std::string_view::npos ? text.size() : feed + 1);
  }
  return reader.finish();
}

}  // namespace skein::exchange
