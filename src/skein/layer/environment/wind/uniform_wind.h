// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/role/wind_field.h"

namespace skein::environment {

/// Velocity of air that blows with `speed` [m/s] from the bearing `from` [rad].
inline Vec2 blowing_from(double speed, double from) {
  return -speed * geo::unit(from);
}

struct UniformWindOptions {
  double speed = 0;  ///< [m/s]
  double from = 0;   ///< bearing it comes from [rad, clockwise from north]
};

/// The same horizontal wind everywhere and always.
class UniformWind final : public WindField {
 public:
  explicit UniformWind(const UniformWindOptions& options) : velocity_(Vec3::Zero()) {
    velocity_.head<2>() = blowing_from(options.speed, options.from);
  }
  Vec3 wind(const Vec3&, Time) const override { return velocity_; }

 private:
  Vec3 velocity_;
};

}  // namespace skein::environment
