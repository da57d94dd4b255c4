// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/vehicle/vehicle.h"
#include "skein/data/vehicle/vehicle_report.h"

namespace skein::mixed {

/// Where a vehicle is between its reports.
///
/// From the newest motion on it flies a circle of the turn rate that its bank gives (a
/// fixed wing) or straight on:
///
///   omega = g tan(roll) / V,   p(t) = p + t R(omega t / 2) v sinc(omega t / 2)
///
/// For longer than 1.5 s no turn is believed. The deviation grows as if it accelerated
/// at random: sd^2 = sd_0^2 + (a t^2 / 2)^2.
class MotionTracker {
 public:
  explicit MotionTracker(bool turns_by_banking) : turns_by_banking_(turns_by_banking) {}

  /// Older motions than the newest are passed over.
  void add(const VehicleMotion& motion);

  bool known() const { return motion_.has_value(); }
  /// Of the newest motion; only when known().
  Time time() const { return motion_->time; }
  const VehicleMotion& newest() const { return *motion_; }

  /// The motion at `now`; only when known().
  VehicleMotion at(Time now) const;

 private:
  bool turns_by_banking_;
  std::optional<VehicleMotion> motion_;
};

/// As an estimate; its `time` is that of the motion.
NavEstimate as_estimate(const VehicleMotion& motion);

/// As sensors see a vehicle that is where the motion says.
VehicleState as_state(const VehicleMotion& motion, bool on_ground);

}  // namespace skein::mixed
