// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/fleet_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "skein/exchange/table/csv_table.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

// The columns of a start; those of a goal follow in the same order.
enum FleetPlaceColumn {
  kFleetNorth,
  kFleetEast,
  kFleetLatitude,
  kFleetLongitude,
  kFleetAltitude,
  kFleetHeading,
  kFleetPlaceColumns
};
enum FleetColumn : std::size_t {
  kFleetStart = 0,
  kFleetGoal = kFleetPlaceColumns,
  kFleetName = 2 * kFleetPlaceColumns,
  kFleetEarliest,
  kFleetLatest,
  kFleetColumns
};
constexpr std::array<CsvColumn, kFleetColumns> kFleetTable = {
    CsvColumn{"start_north_m", false},
    CsvColumn{"start_east_m", false},
    CsvColumn{"start_latitude_deg", false},
    CsvColumn{"start_longitude_deg", false},
    CsvColumn{"start_altitude_m", false},
    CsvColumn{"start_heading_deg"},
    CsvColumn{"goal_north_m", false},
    CsvColumn{"goal_east_m", false},
    CsvColumn{"goal_latitude_deg", false},
    CsvColumn{"goal_longitude_deg", false},
    CsvColumn{"goal_altitude_m", false},
    CsvColumn{"goal_heading_deg"},
    CsvColumn{"name"},
    CsvColumn{"earliest_start_s", false},
    CsvColumn{"latest_start_s", false}};

constexpr double kMaxFleetPlace = 1e6;     // from the origin [m]
constexpr double kMaxFleetAltitude = 2e4;  // [m]
constexpr double kMaxFleetTime = 1e9;      // [s]
constexpr double kMaxFleetWait = 86'400;   // [s]
constexpr std::size_t kMaxFleet = 10'000;  // aircraft

class FleetReader {
 public:
  explicit FleetReader(const FleetDefaults& defaults) : defaults_(defaults) {}

  Result<void> take(const CsvRow& row);
  FleetTable finish() && { return std::move(table_); }
  bool is_empty() const { return table_.rows.empty(); }

 private:
  Result<Vec2> plane_place(const CsvRow& row, std::size_t first) const;
  Result<FlightState> state(const CsvRow& row, std::size_t first);
  Result<void> take_name(const CsvRow& row, FleetRow& out);
  Result<void> take_times(const CsvRow& row, FleetRow& out) const;

  const FleetDefaults& defaults_;
  FleetTable table_;
  std::set<std::string> names_;
  std::optional<bool> has_altitude_;
};

std::string name_of_column(std::size_t column) {
  return std::string(kFleetTable[column].name);
}

// In metres or on Earth, whichever the row has.
Result<Vec2> FleetReader::plane_place(const CsvRow& row, std::size_t first) const {
  const std::size_t north = first + kFleetNorth, east = first + kFleetEast;
  const std::size_t latitude = first + kFleetLatitude;
  const std::size_t longitude = first + kFleetLongitude;
  const auto given = [&](std::size_t column) { return !row.text(column).empty(); };
  const bool in_metres = given(north) || given(east);
  const bool on_earth = given(latitude) || given(longitude);
  if (in_metres && on_earth)
    return row.wrong(fmt::format("{}: given with {}; one of them is allowed.",
                                 name_of_column(given(north) ? north : east),
                                 name_of_column(given(latitude) ? latitude : longitude)));
  if (!in_metres && !on_earth)
    return row.wrong(fmt::format("{}: is needed.", name_of_column(north)),
                     fmt::format("Give {} and {}, or {} and {}.", name_of_column(north),
                                 name_of_column(east), name_of_column(latitude),
                                 name_of_column(longitude)));
  if (on_earth && defaults_.frame == nullptr)
    return row.wrong(
        fmt::format("{}: the origin is not known.", name_of_column(latitude)),
        "Give --origin.");
  const double max_first = in_metres ? kMaxFleetPlace : 90;
  const double max_second = in_metres ? kMaxFleetPlace : 360;
  const auto a = row.number(in_metres ? north : latitude, -max_first, max_first);
  if (!a) return a.error();
  const auto b = row.number(in_metres ? east : longitude, -max_second, max_second);
  if (!b) return b.error();
  const Vec2 p = in_metres ? Vec2(a.value(), b.value())
                           : defaults_.frame->to_plane(a.value(), b.value());
  if (!(p.norm() <= kMaxFleetPlace))
    return row.wrong(
        fmt::format("{}: lies {:.6g} km from the origin; at most {:.0f} km "
                    "are allowed.",
                    name_of_column(in_metres ? north : latitude), p.norm() / 1000,
                    kMaxFleetPlace / 1000));
  return p;
}

Result<FlightState> FleetReader::state(const CsvRow& row, std::size_t first) {
  const auto place = plane_place(row, first);
  if (!place) return place.error();
  const auto heading = row.number(first + kFleetHeading, -360, 360);
  if (!heading) return heading.error();
  const std::size_t column = first + kFleetAltitude;
  double altitude = defaults_.altitude.value_or(0);
  const bool given = !row.text(column).empty();
  if (given) {
    const auto read = row.number(column, -kMaxFleetAltitude, kMaxFleetAltitude);
    if (!read) return read.error();
    altitude = read.value();
  }
  const bool known = given || defaults_.altitude.has_value();
  if (has_altitude_.value_or(known) != known)
    return row.wrong(fmt::format("{}: some places have an altitude and some have none.",
                                 name_of_column(column)),
                     "Give all, or --altitude-m.");
  has_altitude_ = known;
  return FlightState{{place.value().x(), place.value().y(), -altitude},
                     geo::radians(heading.value())};
}

Result<void> FleetReader::take_name(const CsvRow& row, FleetRow& out) {
  out.name = row.text(kFleetName);
  if (out.name.empty()) return row.wrong("name: is empty.");
  if (!names_.insert(out.name).second)
    return row.wrong(fmt::format("name: {} is there twice.", out.name));
  return {};
}

Result<void> FleetReader::take_times(const CsvRow& row, FleetRow& out) const {
  out.earliest_start = defaults_.earliest_start;
  if (!row.text(kFleetEarliest).empty()) {
    const auto read = row.number(kFleetEarliest, -kMaxFleetTime, kMaxFleetTime);
    if (!read) return read.error();
    out.earliest_start = read.value();
  }
  out.latest_start = defaults_.latest_start.value_or(out.earliest_start);
  if (!row.text(kFleetLatest).empty()) {
    const auto read = row.number(kFleetLatest, -kMaxFleetTime, kMaxFleetTime);
    if (!read) return read.error();
    out.latest_start = read.value();
  }
  const double wait = out.latest_start - out.earliest_start;
  if (wait < 0)
    return row.wrong(fmt::format("latest_start_s: {} is before the earliest start, {}.",
                                 out.latest_start, out.earliest_start));
  if (wait > kMaxFleetWait)
    return row.wrong(
        fmt::format("latest_start_s: {} is more than a day after the earliest start, {}.",
                    out.latest_start, out.earliest_start));
  return {};
}

Result<void> FleetReader::take(const CsvRow& row) {
  if (table_.rows.size() == kMaxFleet)
    return row.wrong(fmt::format("more than {} aircraft.", kMaxFleet));
  FleetRow out;
  if (auto good = take_name(row, out); !good) return good;
  const auto start = state(row, kFleetStart);
  if (!start) return start.error();
  const auto goal = state(row, kFleetGoal);
  if (!goal) return goal.error();
  out.start = start.value();
  out.goal = goal.value();
  if (auto good = take_times(row, out); !good) return good;
  table_.has_altitude = *has_altitude_;
  table_.rows.push_back(std::move(out));
  return {};
}

}  // namespace

Result<FleetTable> read_fleet_table(std::string_view text, const std::string& place,
                                    const FleetDefaults& defaults) {
  FleetReader reader(defaults);
  const auto read = read_csv_table(text, place, kFleetTable,
                                   [&](const CsvRow& row) { return reader.take(row); });
  if (!read) return read.error();
  if (reader.is_empty())
    return Error{ErrorCode::kBadInput, place, "has no aircraft.", "Give a row for each."};
  return std::move(reader).finish();
}

}  // namespace skein::exchange
