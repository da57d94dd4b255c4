// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/grown_zone.h"

#include <algorithm>

#include "skein/geo/clip.h"

namespace skein::reasoning {
namespace {

constexpr double kGrownTolerance = 1;  // of the arcs around grown corners [m]

}  // namespace

Zone grown(Zone zone, double margin, double vertical) {
  if (auto* disc = std::get_if<Disc>(&zone.area)) {
    disc->radius += std::max(margin, 0.0);
  } else if (margin > 0) {
    const geo::Region region = geo::grown({outline(zone)}, margin, kGrownTolerance);
    zone.area = *std::max_element(region.begin(), region.end(),
                                  [](const geo::Ring& a, const geo::Ring& b) {
                                    return geo::signed_area(a) < geo::signed_area(b);
                                  });
  }
  zone.floor_msl -= vertical;
  zone.ceiling_msl += vertical;
  return zone;
}

}  // namespace skein::reasoning
