// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/data/vehicle/pilot.h"
#include "skein/layer/autopilot/control/energy_control.h"
#include "skein/layer/autopilot/control/surface_control.h"

namespace skein::autopilot {

/// Flies a fixed wing after a demand: bank from lateral acceleration, height and airspeed
/// by energy, attitude and turn rates by surfaces.
///
///   tan(phi_d) = a_lateral / (g cos(chi - psi))
///
/// with chi the course over ground and psi the heading of the air velocity. The bank is
/// bounded by the airframe's limit and by the lift at this airspeed.
///
/// Outputs are finite and in range whatever the demand and the state are. If one of them
/// is not finite, the last output is held. All calls are free of allocation.
/// Reference: [Beard12] Eq. (9.14).
class FixedWingControl {
 public:
  explicit FixedWingControl(std::shared_ptr<const FixedWingSetup> setup);
  FixedWingControl(const FixedWingAirframe& airframe, const FixedWingGains& gains);

  /// Another law, or nobody, has flown: the next control() goes on from the state now and
  /// the last output.
  void reset(const NavState& nav);

  /// New gains in flight, without a jump.
  void change(std::shared_ptr<const FixedWingSetup> setup);

  Actuators control(const FixedWingDemand& demand, const NavState& nav, double dt);

  /// Inner loops only: holds bank and pitch, throttle as demanded. Bank and pitch are
  /// bounded by the airframe's limits.
  Actuators stabilize(const AttitudeDemand& demand, const NavState& nav, double dt);

  /// Sticks straight to the surfaces, around the elevator's trim.
  Actuators manual(const PilotInput& sticks, const NavState& nav, double dt);

  /// What the pilot's sticks mean when stabilized: full stick is the airframe's limit.
  AttitudeDemand attitude_for(const PilotInput& sticks) const;

  const FixedWingSetup& setup() const { return *setup_; }

 private:
  double bank_demand(const FixedWingDemand& demand, const NavState& nav) const;
  Actuators ground_run(const FixedWingDemand& demand, const NavState& nav,
                       const Tilt& tilt, double dt);
  Actuators stand(const NavState& nav, const Tilt& tilt, double dt);
  SurfaceDemand without_lift() const;
  void move_roll(double aim, double dt);

  std::shared_ptr<const FixedWingSetup> setup_;
  EnergyControl energy_;
  SurfaceControl surfaces_;
  double roll_ = 0;                  // demanded, rate bounded [rad]
  double roll_rate_ = 0;             // at which that changes [rad/s]
  Vec2 run_heading_ = Vec2::Zero();  // on the ground, unit; zero: none
  Actuators last_;
  bool fresh_ = true;   // the state is to be taken over first
  bool flown_ = false;  // there is a last output; before, flight begins in trim
};

}  // namespace skein::autopilot
