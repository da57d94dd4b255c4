// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/time.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

namespace skein::autopilot {

/// What an autopilot flies by: its estimate of the own motion at `time`.
struct NavState {
  Time time;
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  Quat q_NB = Quat::Identity();
  Vec3 w_NB_B = Vec3::Zero();  ///< rate of turn [rad/s]
  Vec3 wind_N = Vec3::Zero();  ///< [m/s]
  double airspeed = 0;         ///< [m/s]
};

}  // namespace skein::autopilot
