// SPDX-License-Identifier: Apache-2.0
#include "app/plan/input.h"

#include <fmt/format.h>

#include <cmath>

#include "skein/base/csv.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::app {
namespace {

constexpr double kFarthest = 1e6;   // from the origin [m]
constexpr double kHighest = 20000;  // [m]
constexpr const char* kLocalForm = "NORTH,EAST,HEADING_DEG[,ALTITUDE], metres";
constexpr const char* kGeoForm = "LAT,LON,HEADING_DEG[,ALTITUDE], degrees and metres";

Error wrong(const std::string& option, const std::string& message,
            const std::string& hint = "") {
  return {ErrorCode::kBadInput, option, message, hint};
}

Result<geo::Geodetic> geodetic(const std::string& option,
                               const std::vector<double>& numbers) {
  if (std::abs(numbers[0]) > 90 || std::abs(numbers[1]) > 360)
    return wrong(option,
                 fmt::format("latitude {} and longitude {}: the latitude must be within "
                             "-90 to 90, the longitude within -360 to 360.",
                             numbers[0], numbers[1]),
                 "The latitude comes first.");
  return geo::Geodetic{numbers[0], numbers[1], 0};
}

Result<Vec2> wind_of(const PlanSetting& given) {
  if (!given.wind.empty() && !given.wind_from.empty())
    return wrong("--wind", "given with --wind-from; one of them is allowed.");
  if (!given.wind.empty()) {
    const auto n = numbers_of("--wind", given.wind, 2, 2, "NORTH,EAST in m/s");
    if (!n) return n.error();
    return Vec2(n.value()[0], n.value()[1]);
  }
  if (given.wind_from.empty()) return Vec2(0, 0);
  const auto n = numbers_of("--wind-from", given.wind_from, 2, 2,
                            "SPEED,BEARING_DEG in m/s and degrees");
  if (!n) return n.error();
  if (n.value()[0] < 0)
    return wrong("--wind-from",
                 fmt::format("speed {} must be at least 0.", n.value()[0]));
  return Vec2(-n.value()[0] * geo::unit(geo::radians(n.value()[1])));
}

Result<std::optional<geo::Geodetic>> origin_of(
    const PlanSetting& given, const std::optional<geo::Geodetic>& elsewhere) {
  if (given.origin.empty()) return elsewhere;
  const auto n = numbers_of("--origin", given.origin, 2, 2, "LAT,LON in degrees");
  if (!n) return n.error();
  const auto place = geodetic("--origin", n.value());
  if (!place) return place.error();
  return std::optional(place.value());
}

Result<model::AirMotion> air_of(const PlanSetting& given) {
  if (!given.airspeed) return wrong("--airspeed", "is needed, in m/s.");
  if (!given.turn_radius) return wrong("--turn-radius", "is needed, in metres.");
  const auto wind = wind_of(given);
  if (!wind) return wind.error();
  if (wind.value().norm() >= *given.airspeed)
    return wrong(given.wind.empty() ? "--wind-from" : "--wind",
                 fmt::format("{:.6g} m/s must be below the airspeed, {:.6g} m/s: places "
                             "upwind cannot be reached.",
                             wind.value().norm(), *given.airspeed));
  return model::AirMotion{*given.airspeed, *given.turn_radius, wind.value()};
}

// The first two numbers as a place in the plane.
Result<Vec2> plane_point(const std::string& option, bool in_metres,
                         const std::vector<double>& n, const ReadSetting& setting) {
  Vec2 p(n[0], n[1]);
  if (!in_metres) {
    const auto place = geodetic(option, n);
    if (!place) return place.error();
    if (!setting.frame)
      return wrong(option, "the origin is not known.", "Give --origin.");
    p = setting.frame->to_plane(n[0], n[1]);
  }
  if (!(p.norm() <= kFarthest))
    return wrong(option,
                 fmt::format("lies {:.6g} km from the origin; at most {:.0f} km are "
                             "allowed.",
                             p.norm() / 1000, kFarthest / 1000));
  return p;
}

Result<void> take_course(const std::string& option, FlightState& state,
                         const model::AirMotion& air) {
  const auto heading = model::heading_for_course(state.heading, air.airspeed, air.wind);
  if (!heading)
    return wrong(option,
                 fmt::format("no heading makes good the course {:.6g}° in this wind.",
                             geo::degrees(geo::wrap_2pi(state.heading))),
                 "Give a heading, or another course.");
  state.heading = *heading;
  return {};
}

}  // namespace

Result<std::vector<double>> numbers_of(const std::string& option, const std::string& text,
                                       std::size_t min, std::size_t max,
                                       const std::string& form) {
  std::vector<double> numbers;
  CsvCells cells(text);
  while (const auto cell = cells.next()) {
    const auto value = skein::number_in(*cell);
    if (!value || !std::isfinite(*value))
      return wrong(option, fmt::format("\"{}\" is not a finite number.", *cell),
                   fmt::format("Needed: {}.", form));
    numbers.push_back(*value);
  }
  if (numbers.size() < min || numbers.size() > max)
    return wrong(
        option,
        fmt::format("{} number{} given.", numbers.size(), numbers.size() == 1 ? "" : "s"),
        fmt::format("Needed: {}.", form));
  return numbers;
}

Result<ReadSetting> read_setting(const PlanSetting& given,
                                 const std::optional<geo::Geodetic>& elsewhere) {
  const auto origin = origin_of(given, elsewhere);
  if (!origin) return origin.error();
  const auto air = air_of(given);
  if (!air) return air.error();
  if (!origin.value()) return ReadSetting{std::nullopt, air.value(), given.altitude};
  const auto frame = geo::LocalFrame::at(*origin.value());
  if (!frame) return frame.error();
  return ReadSetting{frame.value(), air.value(), given.altitude};
}

Result<std::optional<geo::Geodetic>> place_of(const std::string& from_geo) {
  if (from_geo.empty()) return std::optional<geo::Geodetic>();
  const auto n = numbers_of("--from-geo", from_geo, 3, 4, kGeoForm);
  if (!n) return n.error();
  const auto place = geodetic("--from-geo", n.value());
  if (!place) return place.error();
  return std::optional(place.value());
}

Result<ReadState> read_state(const std::string& name, const std::string& local,
                             const std::string& geographic, const ReadSetting& setting) {
  const std::string option = "--" + name, geo_option = option + "-geo";
  if (local.empty() == geographic.empty())
    return wrong(
        option, local.empty() ? "is needed." : "given with " + geo_option + ".",
        fmt::format("Give {} {} or {} {}.", option, kLocalForm, geo_option, kGeoForm));
  const bool in_metres = !local.empty();
  const auto read =
      numbers_of(in_metres ? option : geo_option, in_metres ? local : geographic, 3, 4,
                 in_metres ? kLocalForm : kGeoForm);
  if (!read) return read.error();
  const std::vector<double>& n = read.value();
  const auto place = plane_point(in_metres ? option : geo_option, in_metres, n, setting);
  if (!place) return place.error();
  const Vec2& p = place.value();
  ReadState end;
  end.has_altitude = n.size() > 3 || setting.altitude.has_value();
  const double altitude = n.size() > 3 ? n[3] : setting.altitude.value_or(0);
  if (std::abs(altitude) > kHighest)
    return wrong(in_metres ? option : geo_option,
                 fmt::format("altitude {} m must be within -{:.0f} to {:.0f}.", altitude,
                             kHighest, kHighest));
  end.state.p_N = {p.x(), p.y(), -altitude};
  end.state.heading = geo::radians(std::remainder(n[2], 360.0));
  return end;
}

Result<std::vector<ReadState>> read_states(const std::string& name,
                                           const std::vector<std::string>& local,
                                           const std::vector<std::string>& geographic,
                                           const ReadSetting& setting) {
  if (!local.empty() && !geographic.empty())
    return wrong("--" + name, "given with --" + name + "-geo; one of them is allowed.");
  std::vector<ReadState> states;
  for (const std::string& text : local) {
    const auto state = read_state(name, text, "", setting);
    if (!state) return state.error();
    states.push_back(state.value());
  }
  for (const std::string& text : geographic) {
    const auto state = read_state(name, "", text, setting);
    if (!state) return state.error();
    states.push_back(state.value());
  }
  return states;
}

Result<Vec2> read_point(const std::string& name, const std::string& local,
                        const std::string& geographic, const ReadSetting& setting) {
  const std::string option = "--" + name, geo_option = option + "-geo";
  if (local.empty() == geographic.empty())
    return wrong(option, local.empty() ? "is needed." : "given with " + geo_option + ".",
                 fmt::format("Give {} NORTH,EAST or {} LAT,LON.", option, geo_option));
  const bool in_metres = !local.empty();
  const auto n =
      numbers_of(in_metres ? option : geo_option, in_metres ? local : geographic, 2, 2,
                 in_metres ? "NORTH,EAST, metres" : "LAT,LON, degrees");
  if (!n) return n.error();
  return plane_point(in_metres ? option : geo_option, in_metres, n.value(), setting);
}

Result<FlightLimits> limits_of(const PlanLimits& given, const ReadSetting& setting) {
  FlightLimits limits;
  limits.airspeed = setting.air.airspeed;
  limits.turn_radius = setting.air.turn_radius;
  limits.climb_rate = given.climb;
  limits.sink_rate = given.sink;
  limits.climb_acceleration = given.climb_acceleration;
  limits.slowest = given.slowest.value_or(limits.airspeed);
  limits.fastest = given.fastest.value_or(limits.airspeed);
  if (!(limits.slowest <= limits.airspeed))
    return wrong("--slowest", fmt::format("{} m/s is above the airspeed, {} m/s.",
                                          limits.slowest, limits.airspeed));
  if (!(limits.fastest >= limits.airspeed))
    return wrong("--fastest", fmt::format("{} m/s is below the airspeed, {} m/s.",
                                          limits.fastest, limits.airspeed));
  return limits;
}

Result<ReadEnds> read_ends(const PlanEnds& given, const ReadSetting& setting) {
  const auto from = read_state("from", given.from, given.from_geo, setting);
  if (!from) return from.error();
  const auto to = read_state("to", given.to, given.to_geo, setting);
  if (!to) return to.error();
  ReadEnds ends{from.value().state, to.value().state,
                from.value().has_altitude && to.value().has_altitude};
  if (from.value().has_altitude != to.value().has_altitude)
    return wrong(from.value().has_altitude ? "--to" : "--from",
                 "has no altitude, but the other end has.",
                 "Give both, or --altitude-m.");
  if (given.from_course)
    if (auto good = take_course("--from-course", ends.from, setting.air); !good)
      return good.error();
  if (given.to_course)
    if (auto good = take_course("--to-course", ends.to, setting.air); !good)
      return good.error();
  return ends;
}

}  // namespace skein::app
