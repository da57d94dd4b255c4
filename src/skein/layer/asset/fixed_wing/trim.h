// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/layer/asset/fixed_wing/model.h"

namespace skein::asset {

/// A steady flight: straight or turning, level, climbing or sinking.
struct TrimRequest {
  double airspeed = 0;      ///< [m/s]
  double climb_angle = 0;   ///< of the path through the air, up positive [rad]
  double turn_rate = 0;     ///< of the heading, clockwise positive [rad/s]
  double altitude_msl = 0;  ///< [m]
};

/// Whether there is such a flight.
enum class TrimOutcome {
  kFound,
  kNoBalance,         ///< forces and moments cannot be balanced at all
  kStalled,           ///< the wing lifts less than that, or only when stalled
  kElevatorTooSmall,  ///< would need more deflection than there is
  kAileronTooSmall,   ///< same
  kRudderTooSmall,    ///< same
  kThrustTooSmall,    ///< would need more thrust than there is
  kThrustNegative,    ///< would need to be braked
};

/// A steady flight, in still air.
struct Trim {
  double alpha = 0, beta = 0;  ///< [rad]
  double roll = 0, pitch = 0;  ///< [rad]
  Surfaces surfaces;           ///< [rad]
  double thrust = 0;           ///< [N]
  double spin = 0;             ///< of the engine, see Engine
  double throttle = 0;         ///< channel, with a full battery
  double power = 0;            ///< drawn [W]
  Vec3 v_AB_B = Vec3::Zero();  ///< velocity through the air [m/s]
  Vec3 w_NB_B = Vec3::Zero();  ///< [rad/s]
  double residual = 0;         ///< largest of what is left of v' [m/s^2] and w' [rad/s^2]
};

struct TrimResult {
  TrimOutcome outcome = TrimOutcome::kNoBalance;
  Trim trim;  ///< with kNoBalance the nearest found; else balanced, even beyond a limit

  bool found() const { return outcome == TrimOutcome::kFound; }
};

/// Why there is no such trim, in words with numbers; empty when there is one.
std::string reason(const FixedWingModel& model, const TrimResult& result);

/// What drives the aircraft while it is trimmed.
enum class TrimThrust {
  kEngine,  ///< its engine, whose torque is felt
  kDirect,  ///< a bare force, as in open-loop flight; engine and its limits are left out
};

/// Finds angles, deflections and thrust that balance the aircraft.
///
/// Newton's method on v' = 0 and w' = 0 in the turning frame, and for aircraft with a
/// rudder: no specific force along the right axis (the ball is in the middle). Without a
/// rudder the side-slip follows from the rest.
/// @returns  the first of the outcomes, in the order of the enum, that applies.
/// Cost: about 20 us.
/// Reference: [Stevens16] section 3.6 for the constraint of the path.
TrimResult find_trim(const FixedWingModel& model, const TrimRequest& request,
                     TrimThrust thrust = TrimThrust::kEngine);

/// Motion of a trimmed aircraft at a place, in wind that is the same everywhere.
/// @param yaw  [rad].
Motion trimmed_motion(const Trim& trim, const Vec3& p_N, double yaw, const Vec3& wind_N);

}  // namespace skein::asset
