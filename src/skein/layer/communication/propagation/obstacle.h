// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "skein/base/math.h"
#include "skein/data/airspace/zone.h"

namespace skein::communication {

/// An upright prism or cylinder that weakens what passes through it.
struct Obstacle {
  std::variant<geo::Ring, Disc> area = {};
  double base_msl = 0;                      ///< [m], below `top_msl`
  double top_msl = 0;                       ///< [m]
  double attenuation_db = math::kInfinity;  ///< at least 0; infinite: opaque
};

/// Whether the straight line between two places, both in N [m], passes through the
/// obstacle; the same in both directions. Cost: linear in the corners.
bool is_crossed(const Obstacle& obstacle, const Vec3& a, const Vec3& b);

}  // namespace skein::communication
