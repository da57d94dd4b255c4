// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/plan_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "skein/base/csv.h"
#include "skein/base/input_file.h"
#include "skein/geo/place_limits.h"
#include "skein/model/path/flight_plan.h"

namespace skein::exchange {
namespace {

using Json = nlohmann::json;

constexpr double kMaxGap = 1;           // between elements that join [m] and [s]
constexpr double kSameAltitude = 1e-6;  // [m]
constexpr std::size_t kMaxElements = 100'000;
constexpr const char* kHint =
    "Write it with `skein plan ... --out FILE.geojson`, or .csv, with --origin and "
    "--altitude.";

Error wrong(const std::string& place, std::string message) {
  return {ErrorCode::kBadInput, place, std::move(message), kHint};
}

bool sensible(const FlightElement& e) {
  const auto below = [](double x, double limit) { return std::abs(x) <= limit; };
  return below(e.start, 1e9) && e.duration > 0 && e.duration <= 1e7 &&
         e.p_N.allFinite() && e.p_N.cwiseAbs().maxCoeff() <= 1e8 &&
         std::isfinite(e.heading) && e.airspeed > 0 && below(e.airspeed, 1e4) &&
         below(e.turn_rate, 1e3) && below(e.climb_rate, 1e3) &&
         below(e.climb_acceleration, 1e3) && e.wind.allFinite() && e.wind.norm() <= 1e3;
}

// Elements must be flights that join.
Result<FlightPlan> checked(FlightPlan plan, const std::string& place) {
  if (plan.empty()) return wrong(place, "there is no planned flight in it.");
  for (std::size_t k = 0; k < plan.size(); ++k) {
    if (!sensible(plan[k]))
      return wrong(place, fmt::format("element {} is no flight.", k));
    if (k == 0) continue;
    const FlightElement& before = plan[k - 1];
    const double gap = (model::end_of(before).p_N - plan[k].p_N).norm();
    const double late = plan[k].start - (before.start + before.duration);
    if (gap > kMaxGap || std::abs(late) > kMaxGap)
      return wrong(place,
                   fmt::format("element {} begins {:.1f} m and {:.1f} s from where "
                               "the one before it ends.",
                               k, gap, late));
  }
  return plan;
}

// Where a place may be for this frame to hold it; a sentence when it is elsewhere.
std::optional<std::string> too_far(double latitude_deg, double longitude_deg,
                                   const geo::LocalFrame& frame) {
  if (std::abs(latitude_deg) > 90 || std::abs(longitude_deg) > 360)
    return fmt::format("latitude {} and longitude {} are no place.", latitude_deg,
                       longitude_deg);
  const double far = geo::distance_from_origin(frame, latitude_deg, longitude_deg);
  if (far <= geo::kMaxPlaceDistance) return std::nullopt;
  return fmt::format(
      "a place ({}, {}) lies {:.0f} km from the origin; at most {:.0f} km "
      "are allowed.",
      latitude_deg, longitude_deg, far / 1000, geo::kMaxPlaceDistance / 1000);
}

class GeoJsonPlan {
 public:
  explicit GeoJsonPlan(const geo::LocalFrame& frame) : frame_(frame) {}

  // Whether a feature is an element, well-formed; others are passed over.
  bool take(const Json& feature) {
    if (!feature.is_object() || !feature.contains("properties")) return true;
    const Json& is = feature.at("properties");
    if (!is.is_object() || is.value("what", std::string()) != "element") return true;
    const std::string name = is.value("plan", std::string());
    if (!plan_name_) plan_name_ = name;
    if (name != *plan_name_) return true;  // of another flight
    // In parts where the element crosses 180 degrees of longitude.
    const auto first_of = [&](const Json& list) -> const Json& {
      const Json& geometry = feature.at("geometry");
      const bool parts = geometry.at("type").get<std::string>() == "MultiLineString";
      return parts ? list.at(0).at(0) : list.at(0);
    };
    const Json& start = first_of(feature.at("geometry").at("coordinates"));
    FlightElement e;
    const double latitude = start.at(1).get<double>();
    const double longitude = start.at(0).get<double>();
    if (!far) far = too_far(latitude, longitude, frame_);
    if (far) return true;
    const Vec2 at = frame_.to_plane(latitude, longitude);
    has_altitude = has_altitude && start.size() > 2;
    e.p_N = {at.x(), at.y(), start.size() > 2 ? -start.at(2).get<double>() : 0};
    e.start = is.at("start_s").get<double>();
    e.duration = is.at("duration_s").get<double>();
    e.heading = geo::radians(first_of(is.at("headings_deg")).get<double>());
    e.airspeed = is.at("airspeed_mps").get<double>();
    e.climb_rate = is.at("climb_mps").get<double>();
    e.climb_acceleration = is.value("climb_mps2", 0.0);
    e.wind = {is.at("wind_north_mps").get<double>(),
              is.at("wind_east_mps").get<double>()};
    if (is.contains("turn_radius_m")) {
      const bool left = is.at("kind").get<std::string>() == "left turn";
      e.turn_rate = (left ? -1 : 1) * e.airspeed / is.at("turn_radius_m").get<double>();
    }
    plan.push_back(e);
    return plan.size() <= kMaxElements;
  }

  FlightPlan plan;
  bool has_altitude = true;
  std::optional<std::string> far;  // what is wrong with a place

 private:
  const geo::LocalFrame& frame_;
  std::optional<std::string> plan_name_;
};

enum Column {
  kElement,
  kTime,
  kEast,
  kNorth,
  kAltitude,
  kLatitude,
  kLongitude,
  kHeading,
  kCourse,
  kAirspeed,
  kGroundSpeed,
  kClimb,
  kColumns
};
constexpr std::array<std::string_view, kColumns> kNames = {
    "element",    "time_s",       "east_m",           "north_m",
    "altitude_m", "latitude_deg", "longitude_deg",    "heading_deg",
    "course_deg", "airspeed_mps", "ground_speed_mps", "climb_mps"};
using Row = std::array<std::optional<double>, kColumns>;

// What brings an element to its end's altitude; rounded altitudes are no acceleration.
double climb_acceleration(const FlightElement& e, double end_altitude) {
  const double missing = end_altitude + e.p_N.z() - e.climb_rate * e.duration;
  return std::abs(missing) < kSameAltitude ? 0 : 2 * missing / (e.duration * e.duration);
}

// Rows of samples, those of an element one after the other; its end is the next row.
FlightPlan from_rows(const std::vector<Row>& rows, const geo::LocalFrame& frame) {
  FlightPlan plan;
  double turned = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& row = rows[k];
    const bool last = k + 1 == rows.size();
    const bool first = k == 0 || *rows[k - 1][kElement] != *row[kElement];
    if (k > 0) {
      turned += geo::wrap_pi(geo::radians(*row[kHeading] - *rows[k - 1][kHeading]));
      if (first || last) {
        FlightElement& before = plan.back();
        before.duration = *row[kTime] - before.start;
        before.turn_rate = before.duration > 0 ? turned / before.duration : 0;
        before.climb_acceleration = climb_acceleration(before, *row[kAltitude]);
        turned = 0;
      }
    }
    if (!first || last) continue;
    FlightElement& e = plan.emplace_back();
    const Vec2 at = row[kLatitude] && row[kLongitude]
                        ? frame.to_plane(*row[kLatitude], *row[kLongitude])
                        : Vec2(*row[kNorth], *row[kEast]);
    e.p_N = {at.x(), at.y(), -*row[kAltitude]};
    e.start = *row[kTime];
    e.heading = geo::radians(*row[kHeading]);
    e.airspeed = *row[kAirspeed];
    e.climb_rate = *row[kClimb];
    e.wind = *row[kGroundSpeed] * geo::unit(geo::radians(*row[kCourse])) -
             e.airspeed * geo::unit(e.heading);
  }
  return plan;
}

}  // namespace

Result<FlightPlan> plan_from_geojson(std::string_view text, const std::string& place,
                                     const geo::LocalFrame& frame) {
  const Json file = Json::parse(text, nullptr, false);
  if (file.is_discarded() || !file.is_object() || !file.contains("features") ||
      !file.at("features").is_array())
    return wrong(place, "it is no GeoJSON collection of features.");
  GeoJsonPlan reader(frame);
  try {
    for (const Json& feature : file.at("features"))
      if (!reader.take(feature)) return wrong(place, "it has too many elements.");
  } catch (const Json::exception& fault) {
    return wrong(place, fmt::format("an element of the plan is not as `skein plan` "
                                    "writes it: {}",
                                    fault.what()));
  }
  if (reader.far) return wrong(place, *reader.far);
  if (!reader.plan.empty() && !reader.has_altitude)
    return wrong(place, "the plan has no altitudes.");
  return checked(std::move(reader.plan), place);
}

Result<FlightPlan> plan_from_csv(std::string_view text, const std::string& place,
                                 const geo::LocalFrame& frame) {
  std::vector<int> meaning;
  std::vector<Row> rows;
  std::optional<std::string> plan_name;
  int number = 0;
  while (!text.empty()) {
    const std::size_t feed = text.find('\n');
    const std::string_view line = text.substr(0, feed);
    text.remove_prefix(feed == std::string_view::npos ? text.size() : feed + 1);
    ++number;
    if (trimmed(line).empty()) continue;
    CsvCells cells(line);
    if (meaning.empty()) {
      while (const auto cell = cells.next()) {
        const auto known = std::find(kNames.begin(), kNames.end(), trimmed(*cell));
        meaning.push_back(known == kNames.end()
                              ? (trimmed(*cell) == "plan" ? -2 : -1)
                              : static_cast<int>(known - kNames.begin()));
      }
      continue;
    }
    Row row;
    bool other = false;
    for (const int column : meaning) {
      const auto cell = cells.next();
      if (!cell) break;
      if (column == -2) {
        if (!plan_name) plan_name = std::string(*cell);
        other = *plan_name != *cell;
      } else if (column >= 0) {
        const std::string_view text_of_cell = trimmed(*cell);
        auto& value = row[static_cast<std::size_t>(column)];
        value = number_in(text_of_cell);
        if (!text_of_cell.empty() && (!value || !std::isfinite(*value)))
          return wrong(fmt::format("{}:{}", place, number),
                       fmt::format("the column {} has no number.",
                                   kNames[static_cast<std::size_t>(column)]));
      }
    }
    if (other) continue;
    for (const Column needed :
         {kElement, kTime, kHeading, kCourse, kAirspeed, kGroundSpeed, kClimb, kAltitude})
      if (!row[needed] || !std::isfinite(*row[needed]))
        return wrong(fmt::format("{}:{}", place, number),
                     fmt::format("the column {} has no number.", kNames[needed]));
    const bool on_earth = row[kLatitude] && row[kLongitude];
    if (!on_earth && !(row[kNorth] && row[kEast]))
      return wrong(fmt::format("{}:{}", place, number), "it has no place.");
    if (on_earth)
      if (const auto far = too_far(*row[kLatitude], *row[kLongitude], frame))
        return wrong(fmt::format("{}:{}", place, number), *far);
    if (rows.size() > 10 * kMaxElements) return wrong(place, "it has too many rows.");
    rows.push_back(row);
  }
  return checked(from_rows(rows, frame), place);
}

Result<FlightPlan> read_plan(const std::filesystem::path& file,
                             const geo::LocalFrame& frame) {
  const std::string place = file.string();
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const bool csv = ending == ".csv";
  if (!csv && ending != ".geojson" && ending != ".json")
    return wrong(place, "plans are read from .geojson, .json and .csv files.");
  const auto content = read_file(file);
  if (!content) return content.error();
  return csv ? plan_from_csv(content.value(), place, frame)
             : plan_from_geojson(content.value(), place, frame);
}

}  // namespace skein::exchange
