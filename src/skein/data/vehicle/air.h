// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/vec.h"

namespace skein {

/// The air that a vehicle flies in.
struct Air {
  Vec3 wind_N = Vec3::Zero();   ///< velocity of the air over ground, gusts included [m/s]
  Vec3 rates_B = Vec3::Zero();  ///< rotation of the air about the body's axes [rad/s]
  double density = 1.225;       ///< [kg/m^3]
};

/// What one vehicle feels beyond the mean wind.
struct Gust {
  Vec3 velocity_N = Vec3::Zero();  ///< of the air, to be added to the mean wind [m/s]
  Vec3 rates_B = Vec3::Zero();     ///< rotation of the air about the body's axes [rad/s]
};

/// Gravity at the surface [m/s^2]; constant, the Earth being flat in N.
inline constexpr double kGravity = 9.80665;

}  // namespace skein
