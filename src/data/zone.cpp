#include "data/zone.h"

#include <algorithm>
#include <cmath>

namespace skein {

bool covers(const Zone& zone, const Vec2& p) {
  if (const auto* disc = std::get_if<Disc>(&zone.area))
    return (p - disc->centre).squaredNorm() < disc->radius * disc->radius;
  return geo::contains(std::get<geo::Ring>(zone.area), p);
}

geo::Ring outline(const Zone& zone, double tolerance) {
  const auto* disc = std::get_if<Disc>(&zone.area);
  if (disc == nullptr) return std::get<geo::Ring>(zone.area);
  // A corner of the polygon around a circle is 1 / cos(half its angle) radii out.
  const double half = std::acos(disc->radius / (disc->radius + tolerance));
  const int corners = std::clamp(static_cast<int>(std::ceil(geo::kPi / half)), 8, 512);
  const double out = disc->radius / std::cos(geo::kPi / corners);
  geo::Ring ring;
  ring.reserve(static_cast<std::size_t>(corners));
  for (int i = 0; i < corners; ++i)
    ring.push_back(disc->centre + out * geo::unit(2 * geo::kPi * i / corners));
  return ring;
}

}  // namespace skein
