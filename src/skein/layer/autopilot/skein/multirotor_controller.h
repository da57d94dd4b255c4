// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/autopilot/control/multirotor_control.h"
#include "skein/layer/autopilot/guidance/multirotor_guidance.h"
#include "skein/layer/autopilot/skein/controller.h"
#include "skein/layer/autopilot/skein/skein_setup.h"

namespace skein::autopilot {

/// Flies a multirotor; see controller.h.
class MultirotorController {
 public:
  MultirotorController(const SkeinSetup& setup, const Vec3& home_N);

  std::optional<std::string> command(const AutopilotCommand& command,
                                     const ControllerView& now);
  Control fly(const ControllerView& now, double dt);
  void begin_descent(const ControllerView& now);
  /// Straight down above the ground below; without a position, with level attitude.
  Control descend(const ControllerView& now, double dt);
  Control pilot(const PilotInput& sticks, const ControllerView& now, double dt);
  Control stand(const ControllerView& now, double dt);
  Control release(const ControllerView& now, double dt) { return stand(now, dt); }
  void take_over(const ControllerView& now);
  static bool coordinated() { return true; }
  const AutopilotStatus& status() const { return guidance_.status(); }

  /// Bit k: rotor k gives nothing.
  void set_standing(std::uint8_t rotors) { control_.set_standing(rotors); }

 private:
  MultirotorGuidance guidance_;
  MultirotorControl control_;
  double sink_rate_;             // largest [m/s]
  double descent_altitude_ = 0;  // demanded now [m]
  double heading_ = 0;           // of a blind descent [rad]
  double still_for_ = 0;         // it seems to stand, likewise [s]
};

}  // namespace skein::autopilot
