// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/role/traffic_aircraft.h"

namespace skein::environment {

/// What an aircraft with a pilot can do.
struct PilotedLimits {
  double turn_rate = geo::radians(6);  ///< at most [rad/s]
  double climb = 4;                    ///< at most, up and down [m/s]
  double acceleration = 1;             ///< at most, along the course [m/s^2]
};

/// What its pilot wants.
struct PilotedSetpoint {
  double course = 0;    ///< [rad]
  double speed = 40;    ///< over ground, level part [m/s]
  double altitude = 0;  ///< above mean sea level [m]
};

/// An aircraft that turns, climbs and accelerates within limits.
class PilotedMotion {
 public:
  /// @param begin  in N [m].
  PilotedMotion(const Vec3& begin, double course, double speed)
      : p_N_(begin), course_(course), speed_(speed) {}

  /// Flies on for dt [s], towards a setpoint.
  void step(const PilotedSetpoint& setpoint, const PilotedLimits& limits, double dt);

  const Vec3& p_N() const { return p_N_; }
  Vec3 v_N() const;
  double course() const { return course_; }

 private:
  Vec3 p_N_;
  double course_, speed_, climb_ = 0;
};

}  // namespace skein::environment
