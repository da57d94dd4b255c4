// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/autopilot.h"

namespace skein::autopilot {

/// What lateral guidance needs to know.
struct Motion {
  Vec2 position = Vec2::Zero();  ///< [m]
  double heading = 0;            ///< [rad]
  double airspeed = 0;           ///< [m/s]
  Vec2 wind = Vec2::Zero();      ///< as felt now [m/s]
};

struct GuidanceOptions {
  double heading_gain = 1.2;  ///< turn rate per heading error [1/s]
  double look_ahead = 3;  ///< flight time in which a cross-track error is taken out [s]
  double anticipation = 0.35;  ///< turns of a path are begun this much early [s]
};

/// A course over ground to fly, and how fast it should change.
struct CourseDemand {
  double course = 0;  ///< [rad]
  double rate = 0;    ///< [rad/s]
};

/// Turn rate of the heading [rad/s] that meets a demand in wind.
///
///   omega = k (psi_d - psi) + rate V_g / (V_a cos(chi - psi))
///
/// with psi_d from the wind triangle. The second term is the turn rate at which the
/// course of the ground velocity changes at `rate` in a steady wind.
double turn_rate_for(const CourseDemand& demand, const Motion& motion,
                     const GuidanceOptions& options);

/// Back to a line or arc with course chi_p and curvature kappa, from the cross-track e.
///
///   chi = chi_p - atan(e / (look_ahead V_g)),  rate = kappa V_g cos(chi - chi_p) / (1 -
///   kappa e)
CourseDemand track(double course, double curvature, double cross_track,
                   double ground_speed, const GuidanceOptions& options);

/// Onto a circle and around it.
CourseDemand circle(const Circle& circle, const Vec2& position, double ground_speed,
                    const GuidanceOptions& options);

}  // namespace skein::autopilot
