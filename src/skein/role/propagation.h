// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/vec.h"

namespace skein {

inline constexpr double kSpeedOfLight = 299'792'458;  ///< [m/s]

/// What is left of a radio signal at another place. Immutable during a run.
class Propagation {
 public:
  virtual ~Propagation() = default;

  /// Power at `to` of a signal sent at `from`, both in N [m].
  ///
  /// @param radiated  power times the gains of both antennas [W], above 0
  /// @returns  [W], at least 0; never above `radiated`; the same in both directions but
  ///           for roundings
  virtual double received(double radiated, const Vec3& from, const Vec3& to) const = 0;
};

}  // namespace skein
