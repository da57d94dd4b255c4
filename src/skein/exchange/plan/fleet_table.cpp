// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/fleet_table.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "skein/base/csv.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

constexpr std::array<std::string_view, 3> kFleetRequired = {"name", "start_heading_deg",
                                                            "goal_heading_deg"};
constexpr std::array<std::string_view, 12> kFleetOptional = {
    "start_north_m",      "start_east_m",    "start_latitude_deg", "start_longitude_deg",
    "start_altitude_m",   "goal_north_m",    "goal_east_m",        "goal_latitude_deg",
    "goal_longitude_deg", "goal_altitude_m", "earliest_start_s",   "latest_start_s"};

constexpr double kMaxFleetPlace = 1e6;     // from the origin [m]
constexpr double kMaxFleetAltitude = 2e4;  // [m]
constexpr double kMaxFleetTime = 1e9;      // [s]
constexpr double kMaxFleetWait = 86'400;   // [s]
constexpr std::size_t kMaxFleet = 10'000;  // aircraft

class FleetReader {
 public:
  explicit FleetReader(const FleetDefaults& defaults) : defaults_(defaults) {}

  void take(CsvRow& row);
  FleetTable finish() && { return std::move(table_); }
  bool is_empty() const { return table_.rows.empty(); }

 private:
  std::optional<Vec2> plane_place(CsvRow& row, const std::string& end) const;
  std::optional<FlightState> state(CsvRow& row, const std::string& end);
  bool take_name(CsvRow& row, FleetRow& out);
  bool take_times(CsvRow& row, FleetRow& out) const;

  const FleetDefaults& defaults_;
  FleetTable table_;
  std::set<std::string> names_;
  std::optional<bool> has_altitude_;
};

// In metres or on Earth, whichever the row has. `end` is start or goal.
std::optional<Vec2> FleetReader::plane_place(CsvRow& row, const std::string& end) const {
  const std::string north = end + "_north_m", east = end + "_east_m";
  const std::string latitude = end + "_latitude_deg", longitude = end + "_longitude_deg";
  const auto given = [&](const std::string& column) { return !row.text(column).empty(); };
  const bool in_metres = given(north) || given(east);
  const bool on_earth = given(latitude) || given(longitude);
  const auto wrong = [&](const std::string& column, const std::string& what) {
    row.report(column, what);
    return std::nullopt;
  };
  if (in_metres && on_earth)
    return wrong(given(north) ? north : east,
                 fmt::format("given with {}; one of them is allowed.",
                             given(latitude) ? latitude : longitude));
  if (!in_metres && !on_earth)
    return wrong(north, fmt::format("is needed, with {}; or {} and {}.", east, latitude,
                                    longitude));
  if (on_earth && defaults_.frame == nullptr)
    return wrong(latitude, "the origin is not known; give --origin.");
  const double max_first = in_metres ? kMaxFleetPlace : 90;
  const double max_second = in_metres ? kMaxFleetPlace : 360;
  const auto a = row.number(in_metres ? north : latitude, -max_first, max_first);
  const auto b = row.number(in_metres ? east : longitude, -max_second, max_second);
  if (!a || !b) return std::nullopt;
  const Vec2 p = in_metres ? Vec2(*a, *b) : defaults_.frame->to_plane(*a, *b);
  if (!(p.norm() <= kMaxFleetPlace))
    return wrong(in_metres ? north : latitude,
                 fmt::format("lies {:.6g} km from the origin; at most {:.0f} km are "
                             "allowed.",
                             p.norm() / 1000, kMaxFleetPlace / 1000));
  return p;
}

std::optional<FlightState> FleetReader::state(CsvRow& row, const std::string& end) {
  const auto place = plane_place(row, end);
  const auto heading = row.number(end + "_heading_deg", -360, 360);
  const std::string column = end + "_altitude_m";
  std::optional<double> altitude = defaults_.altitude;
  const bool given = !row.text(column).empty();
  if (given) altitude = row.number(column, -kMaxFleetAltitude, kMaxFleetAltitude);
  if (!place || !heading || (given && !altitude)) return std::nullopt;
  const bool known = altitude.has_value();
  if (has_altitude_.value_or(known) != known) {
    row.report(column,
               "some places have an altitude and some have none; give all, or "
               "--altitude-m.");
    return std::nullopt;
  }
  has_altitude_ = known;
  return FlightState{{place->x(), place->y(), -altitude.value_or(0)},
                     geo::radians(*heading)};
}

bool FleetReader::take_name(CsvRow& row, FleetRow& out) {
  out.name = row.text("name");
  if (out.name.empty())
    row.report("name", "is empty.");
  else if (!names_.insert(out.name).second)
    row.report("name", fmt::format("{} is there twice.", out.name));
  else
    return true;
  return false;
}

bool FleetReader::take_times(CsvRow& row, FleetRow& out) const {
  const auto time = [&](std::string_view column, double otherwise) {
    return row.text(column).empty() ? std::optional(otherwise)
                                    : row.number(column, -kMaxFleetTime, kMaxFleetTime);
  };
  const auto earliest = time("earliest_start_s", defaults_.earliest_start);
  if (!earliest) return false;
  const auto latest = time("latest_start_s", defaults_.latest_start.value_or(*earliest));
  if (!latest) return false;
  out.earliest_start = *earliest;
  out.latest_start = *latest;
  const double wait = *latest - *earliest;
  if (wait < 0)
    row.report("latest_start_s",
               fmt::format("{} is before the earliest start, {}.", *latest, *earliest));
  if (wait > kMaxFleetWait)
    row.report("latest_start_s",
               fmt::format("{} is more than a day after the earliest start, {}.", *latest,
                           *earliest));
  return wait >= 0 && wait <= kMaxFleetWait;
}

void FleetReader::take(CsvRow& row) {
  if (table_.rows.size() == kMaxFleet)
    return row.report("", fmt::format("more than {} aircraft.", kMaxFleet));
  FleetRow out;
  const bool named = take_name(row, out);
  const auto start = state(row, "start");
  const auto goal = state(row, "goal");
  if (!take_times(row, out) || !named || !start || !goal) return;
  out.start = *start;
  out.goal = *goal;
  table_.has_altitude = *has_altitude_;
  table_.rows.push_back(std::move(out));
}

}  // namespace

Result<FleetTable> read_fleet_table(std::string_view text, const std::string& place,
                                    const FleetDefaults& defaults) {
  FleetReader reader(defaults);
  const auto problems = read_csv(text, place, {kFleetRequired, kFleetOptional},
                                 [&](CsvRow& row) { reader.take(row); });
  if (auto good = first_problem(problems); !good) return good.error();
  if (reader.is_empty())
    return Error{ErrorCode::kBadInput, place, "has no aircraft.", "Give a row for each."};
  return std::move(reader).finish();
}

}  // namespace skein::exchange
