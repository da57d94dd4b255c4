// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/place_limits.h"

#include <algorithm>

#include "skein/base/math.h"

namespace skein::geo {

double distance_from_origin(const LocalFrame& frame, double latitude_deg,
                            double longitude_deg) {
  constexpr double kRadius = 6371e3;  // mean [m]
  const double chord = frame.to_local({latitude_deg, longitude_deg, 0}).norm();
  return 2 * kRadius * math::asin(std::min(1.0, chord / (2 * kRadius)));
}

}  // namespace skein::geo
