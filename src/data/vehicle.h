#pragma once

#include "base/time.h"
#include "geo/vec.h"

namespace skein {

/// The true motion of a vehicle. N is the local frame with its origin at mean sea level,
/// so the altitude above mean sea level is -p_N.z().
struct VehicleState {
  Vec3 p_N = Vec3::Zero();  ///< position [m]
  Vec3 v_N = Vec3::Zero();  ///< velocity over ground [m/s]
  double airspeed = 0;      ///< [m/s]
  double roll = 0;          ///< [rad], right wing down positive
  double pitch = 0;         ///< [rad], nose up positive
  double heading = 0;       ///< of the air-relative velocity [rad], clockwise from north
};

/// The air that a vehicle flies in.
struct Air {
  Vec3 wind_N = Vec3::Zero();  ///< velocity of the air over ground [m/s]
  double density = 1.225;      ///< [kg/m^3]
};

/// What an autopilot asks of a plant that holds its own attitude.
struct FlightCommand {
  double roll = 0;        ///< [rad]
  double airspeed = 0;    ///< [m/s]
  double climb_rate = 0;  ///< [m/s], up positive
};

/// What a vehicle can do, as planners need it.
struct FlightLimits {
  double airspeed = 20;     ///< cruise [m/s]
  double turn_radius = 60;  ///< smallest, in the air mass at cruise airspeed [m]
  double climb_rate = 3;    ///< largest [m/s]
};

/// What an autopilot's estimator believes about its own vehicle.
struct NavEstimate {
  Time time;
  Vec3 p_N = Vec3::Zero();
  Vec3 v_N = Vec3::Zero();
  double heading = 0;          ///< of the air-relative velocity [rad]
  Vec2 wind_N = Vec2::Zero();  ///< estimated horizontal wind [m/s]
  double position_sd = 0;      ///< per horizontal axis [m]
};

}  // namespace skein
