// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/control.h"
#include "skein/data/vehicle/pilot.h"
#include "skein/layer/autopilot/nav_state.h"

namespace skein::autopilot {

// FixedWingController, MultirotorController and PointController fly one kind of airframe
// each: guidance and control together. They have the same functions, so that
// SkeinAutopilot need not know which it has:
//
//   command(command, now)   takes a command, or returns why it cannot be flown
//   fly(now, dt)            the command in force
//   descend(now, dt)        down, near the place where begin_descent() was called
//   pilot(sticks, now, dt)  what the sticks say
//   stand(now, dt)          motors off
//   release(now, dt)        motors off, surfaces at trim: without attitude
//   coordinated()           whether it flies without side-slip, as it flew last
//   take_over(now)          another has flown: go on from the motion now

/// The own motion, as controllers need it.
struct ControllerView {
  const NavState& nav;
  std::optional<double> height_agl;  ///< measured [m]
  double ground_msl = 0;             ///< believed, where nothing is measured [m]
  bool position = true;              ///< it is known
  bool motor = true;                 ///< it pulls
  bool airspeed = true;              ///< it is measured

  double height() const { return height_agl.value_or(-nav.p_N.z() - ground_msl); }
};

}  // namespace skein::autopilot
