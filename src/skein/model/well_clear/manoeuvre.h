// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "skein/model/well_clear/configuration.h"
#include "skein/model/well_clear/volume.h"

namespace skein::model {

/// What is changed to get out of a conflict.
enum class ManoeuvreKind { kTrack, kSpeed, kVerticalSpeed, kAltitude };
inline constexpr std::size_t kManoeuvreKinds = 4;

/// The own aircraft as manoeuvres start from it, at the origin of the plane.
struct OwnMotion {
  double z = 0;                   ///< above mean sea level [m]
  double vx = 0, vy = 0, vz = 0;  ///< north, east, up [m/s]
};

/// An intruder, horizontally from the own aircraft.
struct IntruderMotion {
  double x = 0, y = 0;            ///< north, east [m]
  double z = 0;                   ///< above mean sea level [m]
  double vx = 0, vy = 0, vz = 0;  ///< north, east, up [m/s]
};

/// Where the own aircraft is at a time of a manoeuvre, from where it began.
struct ManoeuvrePoint {
  double t = 0;                   ///< since the beginning [s]
  double x = 0, y = 0, z = 0;     ///< north, east, up [m]
  double vx = 0, vy = 0, vz = 0;  ///< [m/s]
};

/// The motion relative to an intruder that goes straight on, at a point of a manoeuvre.
inline RelativeMotion relative_motion(const OwnMotion& own, const ManoeuvrePoint& p,
                                      const IntruderMotion& intruder) {
  return {p.x - intruder.x - intruder.vx * p.t,
          p.y - intruder.y - intruder.vy * p.t,
          own.z + p.z - intruder.z - intruder.vz * p.t,
          p.vx - intruder.vx,
          p.vy - intruder.vy,
          p.vz - intruder.vz};
}

/// Climbing or descending to an altitude and levelling off there: accelerate to the rate,
/// keep it (the steady part), and back to level flight. A rate that is higher already
/// towards the altitude is kept. An altitude that is too near to level off at is passed
/// and come back to.
class LevelChange {
 public:
  LevelChange(const OwnMotion& own, const WellClearConfiguration::Altitude& limits,
              double altitude);

  /// @param t  since the beginning [s], from 0 on.
  ManoeuvrePoint at(double t) const;
  double steady_from() const { return t1_; }   ///< [s]
  double steady_until() const { return t2_; }  ///< [s]; the same: no steady part
  double level_at() const { return t3_; }      ///< [s]

 private:
  double vx_, vy_, v0_;
  double rate_;                          // of the steady part, up [m/s]
  double a1_ = 0, a3_ = 0;               // of the first and the last part, up [m/s^2]
  double t1_ = 0, t2_ = 0, t3_ = 0;      // ends of the parts
  double z1_ = 0, z2_ = 0, height_ = 0;  // at these, from the beginning
};

}  // namespace skein::model
