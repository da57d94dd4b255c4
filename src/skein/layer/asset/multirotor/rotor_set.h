// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "skein/data/vehicle/airframe.h"
#include "skein/data/vehicle/control.h"
#include "skein/geo/vec.h"

namespace skein::asset {

using RotorSpeeds = std::array<double, Actuators::kMaxChannels>;  ///< [rad/s]

/// What the forces of all rotors together need to know of their speeds w: sums over the
/// rotors at (x, y) with spin s.
struct RotorSums {
  double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0, wyy = 0;  ///< of w, w x, ... w y^2
  double sw = 0;                                            ///< of s w
  double ww = 0, wwx = 0, wwy = 0, sww = 0;                 ///< of w^2, ... s w^2
  double www = 0;                                           ///< of w^3
};

/// The places of the rotors, and what follows from them.
class RotorSet {
 public:
  explicit RotorSet(std::span<const RotorPlace> places);

  std::size_t size() const { return size_; }

  RotorSums sums(const RotorSpeeds& w) const {
    RotorSums s;
    for (std::size_t i = 0; i < size_; ++i) {
      const double wx = w[i] * x_[i], wy = w[i] * y_[i], ww = w[i] * w[i];
      s.w += w[i];
      s.wx += wx;
      s.wy += wy;
      s.wxx += wx * x_[i];
      s.wxy += wx * y_[i];
      s.wyy += wy * y_[i];
      s.sw += spin_[i] * w[i];
      s.ww += ww;
      s.wwx += w[i] * wx;
      s.wwy += w[i] * wy;
      s.sww += spin_[i] * ww;
      s.www += ww * w[i];
    }
    return s;
  }

  /// Thrusts [N] of least sum of squares that give a total thrust and the moments
  /// (about forward, right, down) [N m]; may be negative.
  std::array<double, Actuators::kMaxChannels> thrusts(double total, const Vec3& moment,
                                                      double torque_ratio) const;

  /// Whether the rotors can give thrust and all three moments independently.
  bool controllable() const;

 private:
  std::size_t size_;
  std::array<double, Actuators::kMaxChannels> x_{}, y_{}, spin_{};
};

}  // namespace skein::asset
