// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/autopilot/nav_state.h"

namespace skein::autopilot {

/// Decides from the own motion whether the vehicle stands on the ground.
///
/// In the air it is on the ground when it has moved so slowly for a second that it cannot
/// fly: a fixed wing both over ground and through the air below a third of its minimum
/// airspeed; a multirotor that neither climbs nor sinks by 0.3 m/s while its motors are
/// commanded less than 0.4 of what it hovers with. A fixed wing that stands in a wind has
/// airspeed: then it has to be slower than 1 m/s over ground for three seconds, and too
/// slow in the air by a tenth. On the ground it is in the air when it climbs, stands
/// higher than where it was by more than the estimate's error may be, or moves and is
/// fast enough to fly.
class LandDetector {
 public:
  /// @param hover  mean throttle in hover; 0 for what cannot hover.
  LandDetector(const FlightLimits& limits, double hover, bool on_ground);

  /// @param throttle  mean of what the motors were last commanded.
  bool step(const NavState& nav, double throttle);

  bool on_ground() const { return on_ground_; }
  /// Whether it has been well above the ground since it left it.
  bool clear() const { return clear_; }

 private:
  bool slow(const NavState& nav, double throttle) const;
  bool stands_in_wind(const NavState& nav) const;

  double slowest_, hover_;
  bool on_ground_;
  bool clear_;  // since it left the ground it has been well above
  std::optional<Time> slow_since_, stands_since_;
  std::optional<double> ground_;  // altitude where it stands or stood last [m]
};

}  // namespace skein::autopilot
