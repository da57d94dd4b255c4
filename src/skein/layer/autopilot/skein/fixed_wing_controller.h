// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/layer/autopilot/control/fixed_wing_control.h"
#include "skein/layer/autopilot/guidance/fixed_wing_guidance.h"
#include "skein/layer/autopilot/skein/controller.h"
#include "skein/layer/autopilot/skein/skein_setup.h"

namespace skein::autopilot {

/// Flies a fixed wing that takes actuators; see controller.h.
class FixedWingController {
 public:
  FixedWingController(const SkeinSetup& setup, const Vec3& home_N);

  std::optional<std::string> command(const AutopilotCommand& command,
                                     const ControllerView& now);
  Control fly(const ControllerView& now, double dt);
  void begin_descent(const ControllerView& now);
  /// In circles, with the motor at a steady sink rate, without it gliding; wings level
  /// for the last metres.
  Control descend(const ControllerView& now, double dt);
  Control pilot(const PilotInput& sticks, const ControllerView& now, double dt);
  Control stand(const ControllerView& now, double dt);
  /// As it would glide by itself.
  Control release(const ControllerView& now, double dt);
  void take_over(const ControllerView& now);
  /// Not on the ground, nor while it lines up with its course to touch down.
  bool coordinated() const;
  const AutopilotStatus& status() const { return guidance_.status(); }

  /// Other gains from the next step on. Nothing jumps: demands go on from where they are
  /// at their bounded rates, integrators keep what they hold.
  void change(const LateralOptions& lateral, std::shared_ptr<const FixedWingSetup> wing);

 private:
  Control control(const FixedWingDemand& demand, const ControllerView& now, double dt);

  FixedWingGuidance guidance_;
  FixedWingControl control_;
  double sink_rate_;                          // of a descent with motor [m/s]
  double cruise_;                             // [m/s]
  double fastest_;                            // [m/s]
  double descent_altitude_ = 0;               // demanded now [m]
  FlightPhase phase_ = FlightPhase::kFlight;  // flown last
};

}  // namespace skein::autopilot
