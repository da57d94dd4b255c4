// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/vec.h"

namespace skein {

/// How strongly an antenna, mounted on a body, sends and receives in each direction.
/// Immutable during a run.
class Antenna {
 public:
  virtual ~Antenna() = default;

  /// Gain beside the nominal one of the radio, as a factor of power.
  ///
  /// @param direction_B  to the other antenna, of length 1, in the body frame B
  /// @returns  at least 0, finite
  virtual double gain(const Vec3& direction_B) const = 0;
};

}  // namespace skein
