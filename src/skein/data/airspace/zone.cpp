// SPDX-License-Identifier: Apache-2.0
#include "skein/data/airspace/zone.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "skein/base/math.h"
#include "skein/geo/self_crossing.h"

namespace skein {
namespace {

constexpr double kMinArea = 1e-2;  // smaller is a line [m^2]
constexpr double kFarthest = 1e7;  // of a place from the origin [m]

// "120.5 m north, -30.0 m east"
std::string place_text(const Vec2& p) {
  char text[80];
  std::snprintf(text, sizeof text, "%.1f m north, %.1f m east", p.x(), p.y());
  return text;
}

std::optional<std::string> error_in(const Disc& disc) {
  if (!disc.centre.allFinite() || disc.centre.cwiseAbs().maxCoeff() > kFarthest)
    return "its centre is no place on the map.";
  if (!(disc.radius > 0) || disc.radius > kFarthest)
    return "its radius must be above 0 m and at most 10,000 km.";
  return {};
}

std::optional<std::string> error_in(const geo::Ring& ring) {
  if (ring.size() < 3) return "its ring has fewer than 3 corners.";
  if (ring.size() > kMaxCorners)
    return "its ring has " + std::to_string(ring.size()) + " corners; " +
           std::to_string(kMaxCorners) + " at most.";
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (!ring[i].allFinite() || ring[i].cwiseAbs().maxCoeff() > kFarthest)
      return "corner " + std::to_string(i) + " of its ring is no place on the map.";
  if (const auto crossing = geo::self_crossing(ring))
    return "its ring crosses itself at " + place_text(crossing->point) +
           ": the sides from corners " + std::to_string(crossing->first) + " and " +
           std::to_string(crossing->second) + ", counted from 0.";
  if (std::abs(geo::signed_area(ring)) < kMinArea) return "its ring has no area.";
  return {};
}

}  // namespace

std::optional<std::string> error_in(const Zone& zone) {
  if (auto error = std::visit([](const auto& area) { return error_in(area); }, zone.area))
    return error;
  if (!(zone.floor_msl < zone.ceiling_msl)) return "its floor is not below its ceiling.";
  if (!(zone.from < zone.until)) return "its end is not after its start.";
  return {};
}

geo::Ring made_positive(geo::Ring ring) {
  if (geo::signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

bool covers(const Zone& zone, const Vec2& p) {
  if (const auto* disc = std::get_if<Disc>(&zone.area))
    return (p - disc->centre).squaredNorm() < disc->radius * disc->radius;
  return geo::contains(std::get<geo::Ring>(zone.area), p);
}

geo::Ring outline(const Zone& zone, double tolerance) {
  const auto* disc = std::get_if<Disc>(&zone.area);
  if (disc == nullptr) return std::get<geo::Ring>(zone.area);
  // A corner of the polygon around a circle is 1 / cos(half its angle) radii out.
  const double half = math::acos(disc->radius / (disc->radius + tolerance));
  const int corners = std::clamp(static_cast<int>(std::ceil(geo::kPi / half)), 8, 512);
  const double out = disc->radius / math::cos(geo::kPi / corners);
  geo::Ring ring;
  ring.reserve(static_cast<std::size_t>(corners));
  for (int i = 0; i < corners; ++i)
    ring.push_back(disc->centre + out * geo::unit(2 * geo::kPi * i / corners));
  return ring;
}

}  // namespace skein
