#pragma once

#include <variant>

#include "base/time.h"
#include "geo/vec.h"

namespace skein {

/// Position and velocity from satellites.
struct GnssFix {
  Time time;
  Vec3 p_N = Vec3::Zero();
  Vec3 v_N = Vec3::Zero();
  double position_sd = 0;  ///< per horizontal axis, as the receiver states it [m]
};

/// The in/out fire sensor: does the ground at the looked-at point burn?
struct FireSample {
  Time time;
  double look_ahead = 0;  ///< horizontal distance of the point ahead of the vehicle [m]
  bool inside = false;
};

/// An ideal edge finder: where the real boundary is, seen from the vehicle. No cheap
/// aircraft has one; it serves the third reading of the tracking benchmark.
struct EdgeSample {
  Time time;
  Vec2 offset = Vec2::Zero();   ///< from the vehicle to the nearest boundary point [m]
  Vec2 tangent = Vec2::Zero();  ///< unit tangent there, fire on its right
};

/// Airspeed and heading, as an air data and attitude system gives them.
struct AirDataSample {
  Time time;
  double airspeed = 0;  ///< [m/s]
  double heading = 0;   ///< [rad]
};

using SensorSample = std::variant<GnssFix, FireSample, EdgeSample, AirDataSample>;

}  // namespace skein
