// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/random.h"
#include "skein/geo/vec.h"

namespace skein::environment {

/// A random function of bearing, bounded by an amplitude: how a start boundary departs
/// from a circle, or a spread rate from its nominal value.
class BearingProfile {
 public:
  /// Zero everywhere.
  BearingProfile() = default;

  /// Smooth: harmonics 1 to `count` with random phases and sizes that fall as
  /// order^-decay, scaled so that the largest absolute value is `amplitude`. With a decay
  /// of 1.75 the root mean square is then amplitude / sqrt(3) on average, as of a uniform
  /// distribution in +-amplitude; a smaller decay gives rougher profiles of smaller rms.
  static BearingProfile harmonics(int count, double amplitude, double decay,
                                  RandomStream& random);

  /// One value per equal sector, the first starting at north, each uniform in
  /// +-amplitude.
  static BearingProfile sectors(int count, double amplitude, RandomStream& random);

  /// The value towards the unit vector `direction`.
  double at(const Vec2& direction) const;

 private:
  std::vector<Vec2> harmonics_;  // of cos and sin of k times the bearing, k from 1
  std::vector<double> sectors_;
};

}  // namespace skein::environment
