// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/vec.h"

namespace skein {

/// The ground. Immutable during a run; any thread may ask.
class Terrain {
 public:
  virtual ~Terrain() = default;

  /// Height of the ground above mean sea level [m] at `p` in N. Finite everywhere: what
  /// lies outside the data is decided when the terrain is made.
  virtual double elevation_msl(const Vec2& p) const = 0;

  /// Slope of the ground: d elevation / d(north, east), dimensionless.
  virtual Vec2 gradient(const Vec2& p) const = 0;

  /// An upper bound of elevation_msl() over the whole plane [m]; infinite when none is
  /// known. Cost: none.
  virtual double highest_msl() const { return math::kInfinity; }
};

}  // namespace skein
