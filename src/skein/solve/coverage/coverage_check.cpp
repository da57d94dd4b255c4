// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/coverage_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/geo/boundary_index.h"
#include "skein/geo/clip.h"
#include "skein/geo/self_crossing.h"
#include "skein/solve/coverage/sweep_lines.h"
#include "skein/solve/path/limits_check.h"

namespace skein::solve {
namespace {

constexpr std::size_t kMaxCorners = 2000;  // of all rings together

CoverageResult refused(CoverageOutcome outcome, std::string reason) {
  CoverageResult result;
  result.outcome = outcome;
  result.reason = std::move(reason);
  return result;
}

// What is wrong with a ring; empty when nothing is.
std::string error_of(const geo::Ring& ring, const std::string& what) {
  if (ring.size() < 3)
    return fmt::format("{} has {} points; at least 3 make an area", what, ring.size());
  if (ring.size() > kMaxCorners)
    return fmt::format("{} has {} points; {} are allowed", what, ring.size(),
                       kMaxCorners);
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!on_map(ring[i]))
      return fmt::format("point {} of {} is not a place within {:.0f} km", i, what,
                         kMaxCoordinate / 1000);
  if (const auto crossing = geo::self_crossing(ring))
    return fmt::format(
        "{} crosses itself at north {:.1f} m, east {:.1f} m: edges {} and {}", what,
        crossing->point.x(), crossing->point.y(), crossing->first, crossing->second);
  if (std::abs(geo::signed_area(ring)) < kMinArea)
    return fmt::format("{} has no area", what);
  return {};
}

std::string error_of(const Zone& zone, const std::string& what) {
  if (const auto* disc = std::get_if<Disc>(&zone.area)) {
    const bool fine =
        on_map(disc->centre) && disc->radius > 0 && disc->radius <= kMaxCoordinate;
    return fine ? "" : what + " is a disc without a place or a radius above 0";
  }
  const geo::Ring& ring = std::get<geo::Ring>(zone.area);
  std::string error = error_of(ring, what);
  if (error.empty() && geo::signed_area(ring) < 0)
    error = what + " runs anticlockwise on the map; turned around it is fine";
  return error;
}

std::optional<CoverageResult> check_aircraft(const CoverageQuery& query) {
  const auto refuse = [&](std::string reason) {
    return refused(CoverageOutcome::kBadAircraft, std::move(reason));
  };
  if (query.aircraft.empty()) return refuse("there is no aircraft");
  if (query.aircraft.size() > 64) return refuse("more than 64 aircraft");
  if (!(std::abs(query.altitude_msl) <= kMaxCoordinate) || !usable_time(query.start_time))
    return refuse("altitude and start time must be numbers, and not absurd");
  if (std::string error = limits_error(query.limits); !error.empty())
    return refuse(std::move(error));
  for (std::size_t k = 0; k < query.aircraft.size(); ++k)
    for (const auto& state : {query.aircraft[k].start, query.aircraft[k].end}) {
      if (!state) continue;
      if (std::string error = state_error(*state); !error.empty())
        return refuse(fmt::format("start or end of aircraft {}: {}", k, error));
      const double climb = query.altitude_msl + state->p_N.z();
      for (const double rate : {climb, -climb})
        if (std::string error = climb_error(rate, query.limits); !error.empty())
          return refuse(fmt::format("aircraft {}: {}", k, error));
    }
  return std::nullopt;
}

// Outside of all zones, a little behind the nearest border of the one that holds p.
std::optional<Vec2> free_place(const Zone& around, const Vec2& p,
                               const std::vector<Zone>& zones) {
  constexpr double kBehind = 1;  // [m]
  const geo::NearestPoint border =
      geo::BoundaryIndex(geo::Region{outline(around)}).nearest(p);
  const Vec2 outwards = border.point - p;
  const double distance = outwards.norm();
  if (distance == 0) return std::nullopt;
  const Vec2 free = p + outwards * ((distance + kBehind) / distance);
  const bool clear = std::none_of(zones.begin(), zones.end(),
                                  [&](const Zone& zone) { return covers(zone, free); });
  return clear ? std::optional(free) : std::nullopt;
}

// A start in a zone that holds then, an end in one that holds for good.
std::optional<CoverageResult> check_blocked(const CoverageQuery& query) {
  const auto blocked = [&](std::size_t aircraft, const FlightState& state,
                           bool start) -> std::optional<CoverageResult> {
    const Vec2 p = geo::horizontal(state.p_N);
    const double altitude = -state.p_N.z();
    for (std::size_t k = 0; k < query.zones.size(); ++k) {
      const Zone& zone = query.zones[k];
      const bool lasts = start ? zone.from <= query.start_time
                               : zone.until == std::numeric_limits<double>::infinity();
      if (!covers(zone, p) || altitude < zone.floor_msl || altitude > zone.ceiling_msl ||
          zone.until < query.start_time || !lasts)
        continue;
      CoverageResult result = refused(CoverageOutcome::kBlocked, "");
      result.free_place = free_place(zone, p, query.zones);
      result.reason =
          fmt::format("the {} of aircraft {} lies in zone {}{}", start ? "start" : "end",
                      aircraft, k, zone.name.empty() ? "" : " \"" + zone.name + "\"");
      if (result.free_place)
        result.reason += fmt::format("; north {:.1f} m, east {:.1f} m is free",
                                     result.free_place->x(), result.free_place->y());
      return result;
    }
    return std::nullopt;
  };
  for (std::size_t a = 0; a < query.aircraft.size(); ++a) {
    const CoverageAircraft& one = query.aircraft[a];
    if (one.start)
      if (auto bad = blocked(a, *one.start, true)) return bad;
    if (one.end)
      if (auto bad = blocked(a, *one.end, false)) return bad;
  }
  return std::nullopt;
}

}  // namespace

std::optional<CoverageResult> check(const CoverageQuery& query) {
  if (std::string error = error_of(query.area, "the area"); !error.empty()) {
    CoverageResult result = refused(CoverageOutcome::kBadArea, std::move(error));
    const bool crosses = query.area.size() >= 3 && query.area.size() <= kMaxCorners &&
                         std::all_of(query.area.begin(), query.area.end(), on_map);
    if (crosses) result.alternative = geo::clean({query.area}, geo::FillRule::kEvenOdd);
    if (result.alternative && result.alternative->empty()) result.alternative.reset();
    return result;
  }
  for (std::size_t k = 0; k < query.holes.size(); ++k)
    if (auto error = error_of(query.holes[k], fmt::format("hole {}", k)); !error.empty())
      return refused(CoverageOutcome::kBadZone, std::move(error));
  for (std::size_t k = 0; k < query.zones.size(); ++k)
    if (auto error = error_of(query.zones[k], fmt::format("zone {}", k)); !error.empty())
      return refused(CoverageOutcome::kBadZone, std::move(error));
  const bool swath_fine =
      std::isfinite(query.swath) && query.swath > 0 && query.overlap >= 0 &&
      query.overlap < 1 && query.overshoot >= 0 && query.overshoot <= kMaxCoordinate &&
      query.zone_distance >= 0 && query.zone_distance <= kMaxCoordinate;
  if (!swath_fine)
    return refused(
        CoverageOutcome::kBadSwath,
        "the swath must be above 0, the overlap from 0 to below 1, overshoot and "
        "distance to zones at least 0");
  if (query.bearing && !std::isfinite(*query.bearing))
    return refused(CoverageOutcome::kBadSwath,
                   "the bearing of the lines is not a number");
  if (auto bad = check_aircraft(query)) return bad;
  if (!query.wind.allFinite())
    return refused(CoverageOutcome::kBadAircraft, "the wind is not a number");
  if (too_windy(query.wind.norm(), query.limits.airspeed))
    return refused(CoverageOutcome::kWindTooStrong,
                   too_strong(query.wind.norm(), query.limits.airspeed));
  return check_blocked(query);
}

std::optional<CoverageResult> check_lines(const CoverageQuery& query,
                                          const geo::Region& area) {
  double widest = 0;
  for (int k = 0; k < 180; ++k)
    widest = std::max(widest, width_across(area, geo::radians(k)));
  const double spacing = query.swath * (1 - query.overlap);
  const double lines = widest / spacing;
  if (lines <= kMaxLines / 2.0) return std::nullopt;
  return refused(
      CoverageOutcome::kTooManyLines,
      fmt::format("lines {:.3g} m apart make {:.0f} over an area {:.0f} m wide; {} are "
                  "allowed: a swath of at least {:.3g} m",
                  spacing, lines, widest, kMaxLines / 2,
                  2 * widest / kMaxLines / (1 - query.overlap)));
}

std::vector<Zone> zones_that_count(const CoverageQuery& query) {
  std::vector<Zone> zones;
  for (const Zone& zone : query.zones)
    if (query.altitude_msl >= zone.floor_msl && query.altitude_msl <= zone.ceiling_msl &&
        zone.until >= query.start_time)
      zones.push_back(zone);
  return zones;
}

geo::Region area_to_cover(const CoverageQuery& query,
                          const std::vector<geo::Ring>& zones) {
  geo::Region cut = zones;
  for (const geo::Ring& hole : query.holes) {
    cut.push_back(hole);
    if (geo::signed_area(hole) < 0) std::reverse(cut.back().begin(), cut.back().end());
  }
  geo::Ring outer = query.area;
  if (geo::signed_area(outer) < 0) std::reverse(outer.begin(), outer.end());
  return geo::subtract({outer}, cut);
}

}  // namespace skein::solve
