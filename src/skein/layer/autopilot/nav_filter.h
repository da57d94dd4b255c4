// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/sensing.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein::autopilot {

/// Position, velocity and wind of a vehicle from satellite fixes and air data.
///
/// Between fixes the position is carried on by the air velocity (airspeed, heading, turn
/// rate) plus the drift, which is the difference to the ground velocity at recent fixes.
/// A fix corrects the position with the gain of a scalar Kalman filter. The wind that is
/// reported is the drift, low-passed: gusts are left out of it.
///
/// The stated `position_sd` is that of the last fix, grown with its age, not the filter's
/// own: satellite errors last for minutes, and averaging does not remove them.
class NavFilter {
 public:
  /// @param initial   what is known at the start; its v_N gives the first airspeed.
  /// @param wind_lag  time constant of the reported wind [s].
  NavFilter(const NavEstimate& initial, double wind_lag);

  void add(const GnssFix& fix);
  void add(const AirDataSample& sample);

  /// Carries the estimate on to `now`; never back.
  void advance(Time now);

  const NavEstimate& estimate() const { return estimate_; }
  double airspeed() const { return airspeed_; }    ///< [m/s]
  double turn_rate() const { return turn_rate_; }  ///< of the heading [rad/s]
  /// Air's velocity over ground as seen just now, gusts included [m/s].
  const Vec2& drift() const { return drift_; }

 private:
  Vec2 air_velocity(double heading) const;

  NavEstimate estimate_;
  double wind_lag_;
  double airspeed_;
  double turn_rate_ = 0;   // [rad/s]
  double climb_rate_ = 0;  // [m/s], up positive
  Vec2 drift_ = Vec2::Zero();
  double variance_ = 0;  // of the position, for the gain [m^2]
  double fix_sd_, fix_altitude_sd_;
  Time fix_time_, air_time_;
  bool has_fix_ = false, has_air_ = false;
  double fixes_seconds_ = 0;  // time over which the wind has been averaged
};

}  // namespace skein::autopilot
