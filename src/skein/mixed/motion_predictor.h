// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/geo/vec.h"

namespace skein::mixed {

/// How a flight model outside moves between what it says, which is milliseconds apart:
/// from the newest motion on with its rates of turn, and with the acceleration between
/// the last two,
///
///   p = p0 + v0 t + a t^2 / 2,   v = v0 + a t,   q = q0 exp(w t)
///
/// for 0.2 s at most. Without errors: what it says is the truth.
class MotionPredictor {
 public:
  void add(const VehicleMotion& motion);
  /// The next motion does not continue the last.
  void forget() { *this = {}; }

  bool known() const { return newest_.has_value(); }
  /// Only when known().
  const VehicleMotion& newest() const { return *newest_; }
  /// The motion at `now`; only when known().
  VehicleMotion at(Time now) const;

 private:
  std::optional<VehicleMotion> newest_;
  Vec3 a_N_ = Vec3::Zero();
};

}  // namespace skein::mixed
