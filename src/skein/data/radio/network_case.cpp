// SPDX-License-Identifier: Apache-2.0
#include "skein/data/radio/network_case.h"

#include <algorithm>

namespace skein {

Vec3 NodeTrack::place(Time time) const {
  const auto after =
      std::upper_bound(points.begin(), points.end(), time,
                       [](Time t, const Point& point) { return t < point.time; });
  if (after == points.begin()) return points.front().place;
  if (after == points.end()) return points.back().place;
  const Point& a = *(after - 1);
  const Point& b = *after;
  const double share = (time - a.time).seconds() / (b.time - a.time).seconds();
  return a.place + share * (b.place - a.place);
}

}  // namespace skein
