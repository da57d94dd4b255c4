// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/traffic/traffic_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "skein/base/csv.h"
#include "skein/base/input_file.h"
#include "skein/geo/place_limits.h"

namespace skein::exchange {
namespace {

enum class LogColumn : std::uint8_t {
  kTime,
  kUnix,
  kNorth,
  kEast,
  kLatitude,
  kLongitude,
  kAltitude,
  kAltitudeFeet,
  kAltitudeGeo,
  kAltitudeBaro,
  kId,
  kOnGround,
  kLastUpdate,
  kSpeed,
  kOther,
};
constexpr std::size_t kLogColumns = static_cast<std::size_t>(LogColumn::kOther) + 1;

struct LogName {
  std::string_view name;
  LogColumn column;
};

constexpr std::array kLogNames = {
    LogName{"time_s", LogColumn::kTime},
    LogName{"unix_s", LogColumn::kUnix},
    LogName{"time", LogColumn::kUnix},
    LogName{"north_m", LogColumn::kNorth},
    LogName{"east_m", LogColumn::kEast},
    LogName{"latitude_deg", LogColumn::kLatitude},
    LogName{"lat", LogColumn::kLatitude},
    LogName{"longitude_deg", LogColumn::kLongitude},
    LogName{"lon", LogColumn::kLongitude},
    LogName{"altitude_msl_m", LogColumn::kAltitude},
    LogName{"altitude_ft", LogColumn::kAltitudeFeet},
    LogName{"geoaltitude", LogColumn::kAltitudeGeo},
    LogName{"baroaltitude", LogColumn::kAltitudeBaro},
    LogName{"id", LogColumn::kId},
    LogName{"icao24", LogColumn::kId},
    LogName{"onground", LogColumn::kOnGround},
    LogName{"velocity_north_mps", LogColumn::kOther},
    LogName{"velocity_east_mps", LogColumn::kOther},
    LogName{"climb_mps", LogColumn::kOther},
    LogName{"ground_speed_mps", LogColumn::kSpeed},
    LogName{"track_deg", LogColumn::kOther},
    LogName{"velocity", LogColumn::kSpeed},
    LogName{"heading", LogColumn::kOther},
    LogName{"vertrate", LogColumn::kOther},
    LogName{"callsign", LogColumn::kOther},
    LogName{"alert", LogColumn::kOther},
    LogName{"spi", LogColumn::kOther},
    LogName{"squawk", LogColumn::kOther},
    LogName{"lastposupdate", LogColumn::kLastUpdate},
    LogName{"time_position", LogColumn::kLastUpdate},
    LogName{"lastcontact", LogColumn::kOther},
    LogName{"hour", LogColumn::kOther},
    LogName{"serials", LogColumn::kOther},
};

constexpr double kFoot = 0.3048;                  // [m]
constexpr std::size_t kLargestLog = 200'000'000;  // [bytes]
constexpr std::size_t kMaxIdLength = 40;
constexpr double kStanding = 2;  // slower, an aircraft may be at one place [m/s]

// Beginnings of columns that would be places, times or altitudes if they were known: a
// mistake or another unit there is not passed over.
constexpr std::string_view kTelling[] = {"time", "unix", "north", "east",   "height",
                                         "lat",  "lon",  "alt",   "geoalt", "baroalt"};

bool is_telling(std::string_view name) {
  return std::any_of(std::begin(kTelling), std::end(kTelling),
                     [&](std::string_view start) { return name.starts_with(start); });
}

std::string small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

// Whether a cell has no value.
bool is_none(std::string_view cell) {
  const std::string word = small_letters(cell);
  return word.empty() || word == "null" || word == "nan" || word == "none" ||
         word == "na" || word == "n/a";
}

// Of a number in a column.
struct LogRange {
  double least, greatest;
};
constexpr LogRange log_range(LogColumn column) {
  switch (column) {
    case LogColumn::kTime:
      return {-1e7, 1e7};
    case LogColumn::kUnix:
      return {0, 7.3e9};
    case LogColumn::kLatitude:
      return {-89, 89};
    case LogColumn::kLongitude:
      return {-180, 180};
    case LogColumn::kAltitudeFeet:
      return {-2000, 200000};
    case LogColumn::kAltitude:
    case LogColumn::kAltitudeGeo:
    case LogColumn::kAltitudeBaro:
      return {-600, 60000};
    default:
      return {-1e7, 1e7};
  }
}

// Of one row, by datum; up [m].
using Altitudes = std::array<std::optional<double>, kAltitudeData>;

// The datum that an aircraft flies by.
AltitudeDatum datum_of(const std::vector<Altitudes>& rows) {
  std::array<std::size_t, kAltitudeData> count{};
  for (const Altitudes& row : rows)
    for (std::size_t d = 0; d < kAltitudeData; ++d) count[d] += row[d] ? 1 : 0;
  std::size_t best = 0;
  for (std::size_t d = 0; d < kAltitudeData; ++d) {
    if (2 * count[d] >= rows.size()) return static_cast<AltitudeDatum>(d);
    if (count[d] > count[best]) best = d;
  }
  return static_cast<AltitudeDatum>(best);
}

using LogCells = std::vector<std::string_view>;  // of a row, by its columns
using LogNumber = std::optional<double>;

class LogReader {
 public:
  LogReader(const std::string& name, const LogPlacement& placement)
      : name_(name), placement_(placement) {}

  Result<TrafficLog> read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      ++line_;
      if (trimmed(line).empty()) continue;
      auto good = columns_.empty() ? header(line) : row(line);
      if (!good) return good.error();
    }
    if (columns_.empty())
      return error("", "the log is empty.", "Its first line names the columns.");
    if (log_.flights.empty() && log_.far > 0)
      return Error{
          ErrorCode::kBadInput, name_,
          fmt::format("lies up to {:.0f} km from the origin; at most {:.0f} km are "
                      "allowed.",
                      log_.farthest / 1000, geo::kMaxPlaceDistance / 1000),
          "Is the origin right?"};
    if (log_.flights.empty())
      return Error{ErrorCode::kBadInput, name_,
                   fmt::format("none of its {} rows has a place in the air.", log_.rows),
                   ""};
    for (std::size_t i = 0; i < log_.flights.size(); ++i)
      settle_altitudes(log_.flights[i], altitudes_[i]);
    return std::move(log_);
  }

 private:
  Error error(std::string_view column, std::string message, std::string hint = {}) const {
    return {ErrorCode::kBadInput,
            column.empty() ? fmt::format("{}:{}", name_, line_)
                           : fmt::format("{}:{} {}", name_, line_, column),
            std::move(message), std::move(hint)};
  }

  bool has(LogColumn column) const {
    return place_[static_cast<std::size_t>(column)].has_value();
  }

  Result<void> header(std::string_view line) {
    CsvCells cells(line);
    while (const auto cell = cells.next()) {
      const auto known =
          std::find_if(kLogNames.begin(), kLogNames.end(),
                       [&](const LogName& each) { return each.name == *cell; });
      if (known == kLogNames.end() && is_telling(*cell))
        return error(shown(*cell), "is no column of a traffic log.",
                     "docs/traffic.md has those that are allowed.");
      for (const std::string& other : columns_)
        if (other == *cell) return error(*cell, "is there twice.");
      const LogColumn column =
          known == kLogNames.end() ? LogColumn::kOther : known->column;
      if (known == kLogNames.end()) log_.ignored.push_back(shown(*cell));
      auto& place = place_[static_cast<std::size_t>(column)];
      if (place && column != LogColumn::kOther)
        return error(*cell,
                     fmt::format("says the same as the column {}.", columns_[*place]));
      place = columns_.size();
      columns_.emplace_back(*cell);
    }
    return check_header();
  }

  Result<void> check_header() const {
    if (has(LogColumn::kTime) == has(LogColumn::kUnix))
      return error("", "needs one column with the time.",
                   "time_s since the start of the run, or unix_s since 1970.");
    const bool local = has(LogColumn::kNorth) && has(LogColumn::kEast);
    const bool global = has(LogColumn::kLatitude) && has(LogColumn::kLongitude);
    if (local == global)
      return error("", "needs two columns with the place.",
                   "north_m and east_m, or latitude_deg and longitude_deg.");
    if (!has(LogColumn::kAltitude) && !has(LogColumn::kAltitudeFeet) &&
        !has(LogColumn::kAltitudeGeo) && !has(LogColumn::kAltitudeBaro))
      return error("", "needs a column with the altitude.",
                   "altitude_msl_m or altitude_ft.");
    return {};
  }

  Result<void> row(std::string_view line) {
    LogCells cells;
    CsvCells rest(line);
    while (const auto cell = rest.next()) cells.push_back(*cell);
    if (cells.size() != columns_.size())
      return error(
          "", fmt::format("{} cells; the header has {}.", cells.size(), columns_.size()));
    ++log_.rows;
    auto time = time_of(cells);
    if (!time) return time.error();
    if (!time.value()) return error("", "has no time.");
    auto place = place_of(cells);
    if (!place) return place.error();
    auto altitudes = altitudes_of(cells);
    if (!altitudes) return altitudes.error();
    const bool has_altitude =
        std::any_of(altitudes.value().begin(), altitudes.value().end(),
                    [](const std::optional<double>& each) { return each.has_value(); });
    auto grounded = on_ground(cells);
    if (!grounded) return grounded.error();
    if (!place.value() || !has_altitude || grounded.value()) {
      ++log_.left_out;
      return {};
    }
    if (is_far(cells)) {
      ++log_.far;
      return {};
    }
    return add(cells, {*time.value(), *place.value()}, altitudes.value());
  }

  // A number, or none where the cell is empty or its column is not there.
  Result<LogNumber> number(const LogCells& cells, LogColumn column) const {
    const auto place = place_[static_cast<std::size_t>(column)];
    if (!place || is_none(cells[*place])) return LogNumber();
    const auto value = number_in(cells[*place]);
    if (!value || !std::isfinite(*value))
      return error(columns_[*place],
                   fmt::format("\"{}\" is no number.", shown(cells[*place])));
    const LogRange range = log_range(column);
    if (*value < range.least || *value > range.greatest)
      return error(columns_[*place], fmt::format("{} must be from {} to {}.", *value,
                                                 range.least, range.greatest));
    return LogNumber(value);
  }

  static std::string shown(std::string_view cell) {
    std::string text;
    for (const char c : cell.substr(0, kMaxIdLength))
      text += c >= ' ' && c <= '~' ? c : '?';
    return text;
  }

  Result<LogNumber> time_of(const LogCells& cells) const {
    if (has(LogColumn::kTime)) return number(cells, LogColumn::kTime);
    auto time = number(cells, LogColumn::kUnix);
    if (time && time.value()) return LogNumber(*time.value() - placement_.start_unix);
    return time;
  }

  // On the plane; what it is above follows when all rows are known.
  Result<std::optional<Vec3>> place_of(const LogCells& cells) const {
    const bool local = has(LogColumn::kNorth);
    const auto a = number(cells, local ? LogColumn::kNorth : LogColumn::kLatitude);
    if (!a) return a.error();
    const auto b = number(cells, local ? LogColumn::kEast : LogColumn::kLongitude);
    if (!b) return b.error();
    if (!a.value() || !b.value()) return std::optional<Vec3>();
    const Vec2 map = local ? Vec2(*a.value(), *b.value())
                           : placement_.frame.to_plane(*a.value(), *b.value());
    return std::optional<Vec3>({map.x(), map.y(), 0});
  }

  Result<Altitudes> altitudes_of(const LogCells& cells) const {
    Altitudes found;
    const auto read = [&](LogColumn column, AltitudeDatum datum,
                          double unit) -> Result<void> {
      const auto altitude = number(cells, column);
      if (!altitude) return altitude.error();
      auto& of_datum = found[static_cast<std::size_t>(datum)];
      if (altitude.value() && !of_datum) of_datum = *altitude.value() * unit;
      return {};
    };
    for (const auto& [column, datum, unit] :
         {std::tuple(LogColumn::kAltitude, AltitudeDatum::kSeaLevel, 1.0),
          std::tuple(LogColumn::kAltitudeFeet, AltitudeDatum::kSeaLevel, kFoot),
          std::tuple(LogColumn::kAltitudeGeo, AltitudeDatum::kGeometric, 1.0),
          std::tuple(LogColumn::kAltitudeBaro, AltitudeDatum::kBarometric, 1.0)})
      if (auto good = read(column, datum, unit); !good) return good.error();
    return found;
  }

  // Gives the places of a flight the altitudes of one datum, and leaves out those that
  // have none of it.
  void settle_altitudes(LoggedFlight& flight, const std::vector<Altitudes>& altitudes) {
    flight.datum = datum_of(altitudes);
    std::vector<LoggedPlace> places;
    for (std::size_t i = 0; i < altitudes.size(); ++i) {
      const auto& up = altitudes[i][static_cast<std::size_t>(flight.datum)];
      if (!up) continue;
      places.push_back(flight.places[i]);
      places.back().p_N.z() = -*up;
    }
    log_.other_datum += flight.places.size() - places.size();
    if (flight.datum == AltitudeDatum::kBarometric) log_.barometric += places.size();
    flight.places = std::move(places);
  }

  Result<bool> on_ground(const LogCells& cells) const {
    const auto place = place_[static_cast<std::size_t>(LogColumn::kOnGround)];
    if (!place) return false;
    const std::string cell = small_letters(cells[*place]);
    if (cell == "true" || cell == "1" || cell == "t") return true;
    if (is_none(cell) || cell == "false" || cell == "0" || cell == "f") return false;
    return error(columns_[*place],
                 fmt::format("\"{}\" is neither true nor false.", shown(cells[*place])));
  }

  // Whether a row, whose place is known to be good, lies too far from the origin.
  bool is_far(const LogCells& cells) {
    if (!has(LogColumn::kLatitude)) return false;
    const auto latitude = number(cells, LogColumn::kLatitude);
    const auto longitude = number(cells, LogColumn::kLongitude);
    const double distance = geo::distance_from_origin(
        placement_.frame, latitude.value().value_or(0), longitude.value().value_or(0));
    if (distance <= geo::kMaxPlaceDistance) return false;
    log_.farthest = std::max(log_.farthest, distance);
    return true;
  }

  // Whether a place repeats the last one of its aircraft because nothing newer was
  // received.
  bool is_old(const LoggedPlace& now, const std::vector<LoggedPlace>& places,
              const LogNumber& update, const LogNumber& last_update,
              const LogNumber& speed) const {
    if (places.empty() || now.p_N.head<2>() != places.back().p_N.head<2>()) return false;
    if (update && last_update) return *update == *last_update;
    return !has(LogColumn::kLastUpdate) && speed.value_or(0) > kStanding;
  }

  // A number that the log may lack; none for anything else.
  LogNumber hint(const LogCells& cells, LogColumn column) const {
    const auto place = place_[static_cast<std::size_t>(column)];
    return place ? number_in(cells[*place]) : std::nullopt;
  }

  Result<void> add(const LogCells& cells, const LoggedPlace& now, const Altitudes& up) {
    std::string id;
    if (const auto place = place_[static_cast<std::size_t>(LogColumn::kId)]) {
      id = shown(cells[*place]);
      if (id.empty() || cells[*place].size() > kMaxIdLength)
        return error(columns_[*place],
                     fmt::format("needs 1 to {} characters.", kMaxIdLength));
    }
    const auto [known, first] = of_id_.try_emplace(id, log_.flights.size());
    if (first) {
      log_.flights.push_back({id, {}, {}});
      last_updates_.emplace_back();
      altitudes_.emplace_back();
    }
    std::vector<LoggedPlace>& places = log_.flights[known->second].places;
    std::vector<Altitudes>& altitudes = altitudes_[known->second];
    LogNumber& last_update = last_updates_[known->second];
    if (!places.empty() && now.time <= places.back().time) {
      if (now.time == places.back().time && now.p_N == places.back().p_N &&
          up == altitudes.back())
        return {};
      return error(
          "", fmt::format("its time does not grow: {:.3f} s after {:.3f} s{}.", now.time,
                          places.back().time, id.empty() ? "" : " of " + id));
    }
    const LogNumber update = hint(cells, LogColumn::kLastUpdate);
    if (is_old(now, places, update, last_update, hint(cells, LogColumn::kSpeed))) {
      ++log_.repeated;
      return {};
    }
    last_update = update;
    places.push_back(now);
    altitudes.push_back(up);
    return {};
  }

  const std::string& name_;
  const LogPlacement& placement_;
  std::size_t line_ = 0;
  std::vector<std::string> columns_;
  std::array<std::optional<std::size_t>, kLogColumns> place_{};
  std::map<std::string, std::size_t> of_id_;
  std::vector<LogNumber> last_updates_;            // of the last place of each flight
  std::vector<std::vector<Altitudes>> altitudes_;  // of all places of each flight
  TrafficLog log_;
};

}  // namespace

Result<TrafficLog> parse_traffic_log(std::string_view text, const std::string& name,
                                     const LogPlacement& placement) {
  return LogReader(name, placement).read(text);
}

Result<TrafficLog> read_traffic_log(const std::filesystem::path& file,
                                    const LogPlacement& placement) {
  auto text = read_file(file, kLargestLog);
  if (!text) {
    Error error = text.error();
    if (std::error_code none;
        std::filesystem::file_size(file, none) > kLargestLog && !none)
      error.hint = "Cut it to the time and place of the run.";
    return error;
  }
  return parse_traffic_log(text.value(), file.filename().string(), placement);
}

}  // namespace skein::exchange
