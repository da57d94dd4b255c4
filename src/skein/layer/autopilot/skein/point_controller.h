// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"
#include "skein/layer/autopilot/skein/controller.h"
#include "skein/layer/autopilot/skein/skein_setup.h"

namespace skein::autopilot {

/// Flies a plant that holds its own attitude: the fixed wing's guidance, and a roll
/// angle, airspeed and climb rate for the plant; see controller.h.
///
///   tan(roll) = a_lateral / (g cos(drift)),  climb = climb_d + k (altitude_d - altitude)
class PointController {
 public:
  PointController(const SkeinSetup& setup, const Vec3& home_N);

  std::optional<std::string> command(const AutopilotCommand& command,
                                     const ControllerView& now);
  Control fly(const ControllerView& now, double dt);
  void begin_descent(const ControllerView& now);
  Control descend(const ControllerView& now, double dt);
  /// Sticks say roll angle, climb rate and airspeed; manual and stabilized are one.
  Control pilot(const PilotInput& sticks, const ControllerView& now, double dt);
  Control stand(const ControllerView& now, double dt);
  Control release(const ControllerView& now, double dt) { return stand(now, dt); }
  void take_over(const ControllerView& now);
  static bool coordinated() { return true; }
  const AutopilotStatus& status() const { return guidance_.status(); }

 private:
  Control for_plant(const FixedWingDemand& demand, const NavState& nav) const;

  FixedWingGuidance guidance_;
  FlightLimits limits_;
  double roll_limit_;     // [rad]
  double altitude_gain_;  // [1/s]
};

}  // namespace skein::autopilot
