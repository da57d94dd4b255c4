// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein {

/// The mean wind. Immutable during a run; any thread may ask.
class WindField {
 public:
  virtual ~WindField() = default;

  /// Velocity of the air over ground in N [m/s] (towards where it blows) at `p_N` and
  /// `time`.
  virtual Vec3 wind(const Vec3& p_N, Time time) const = 0;
};

}  // namespace skein
