// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "skein/layer/asset/multirotor/multirotor_parameters.h"

namespace skein::asset {

/// Density at which rotor numbers hold [kg/m^3].
inline constexpr double kRotorDensity = 1.225;

/// Area of all rotors' discs [m^2].
inline double disc_area(const MultirotorParameters& p) {
  return static_cast<double>(p.rotors.size()) * geo::kPi * p.rotor_radius *
         p.rotor_radius;
}

/// The part of the torque factor that does not pay for induced flow in hover [N m s^2];
/// see MultirotorPlant.
inline double profile_torque_factor(const MultirotorParameters& p) {
  const double area = geo::kPi * p.rotor_radius * p.rotor_radius;
  return p.torque_factor - p.induced_factor * p.thrust_factor *
                               std::sqrt(p.thrust_factor / (2 * kRotorDensity * area));
}

/// Induced speed v of a rotor disc [m/s]: v^2 (along2 + (climb + v)^2) = hover2^2.
///
/// Newton's method from above, where the left side is convex: three steps come within
/// 2 % of the root (see the test) and never below it.
/// @param hover2  square of the induced speed in hover at this thrust [m^2/s^2]
/// @param along2  square of the air speed along the disc [m^2/s^2]
/// @param climb   air speed of the disc along its thrust [m/s]
inline double induced_speed(double hover2, double along2, double climb) {
  const double half = 0.5 * along2;
  const double level =  // the root without climb
      std::sqrt(hover2 * hover2 / (half + std::sqrt(half * half + hover2 * hover2)));
  double v = climb < 0 ? level - climb : level;
  for (int i = 0; i < 3; ++i) {
    const double through = climb + v;
    const double flow2 = along2 + through * through;
    v -= (v * v * flow2 - hover2 * hover2) / (2 * v * (flow2 + v * through));
  }
  return v;
}

}  // namespace skein::asset
