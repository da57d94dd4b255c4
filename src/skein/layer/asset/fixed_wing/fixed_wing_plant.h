// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/asset/fixed_wing/model.h"
#include "skein/role/plant.h"

namespace skein::asset {

/// Six degrees of freedom of a fixed wing with servos, engine and a store of energy.
///
/// Takes Actuators (data/vehicle/control.h); what is not a number counts as 0, the rest
/// is bounded. `VehicleState::actuators` holds the deflections [rad] at the channels of
/// the surfaces and the engine's spin (see Engine) at that of the throttle. Servos and
/// engine follow in closed form, the body by RK4: see rk4_step, Aerodynamics.
///
/// Faults: a dead surface goes to 0, a dead engine to a stand, both with their lags; what
/// is stuck stays. An engine without energy stands as well.
///
/// The density is that of the standard atmosphere at the aircraft's height; that in Air
/// is not used. Wind and its rates are constant within a step.
///
/// On the ground its crew holds it, if the start says so, until the motor is given power:
/// see hold(). One that is launched by hand waits above the ground, in the hand.
///
/// A step is cut into equal parts of at most 10 ms, and shorter ones where the motion is
/// so fast that RK4 would be bad at it (see docs/fixed-wing.md for errors).
/// Valid: constant mass; no ground effect, no propeller wash, no gyroscopic moments.
class FixedWingPlant final : public Plant {
 public:
  /// `parameters` without errors(); else a Bug.
  explicit FixedWingPlant(const FixedWingParameters& parameters);

  FlightLimits limits() const override { return limits_; }
  Airframe airframe() const override { return airframe_; }

  /// In the air: trimmed level flight at cruise through the wind, the forward axis on the
  /// heading. On the ground: at rest, with idle engine; without one it is not held.
  VehicleState start(const VehicleStart& start) const override;

  void step(VehicleState& state, const Control& control, const Air& air,
            double dt) const override;

  Contact touch(VehicleState& state, double ground_msl, double dt) const override;

  const FixedWingModel& model() const { return model_; }

 private:
  double parts(const VehicleState& state, const Air& air, double dt) const;
  void held_step(VehicleState& state, const Actuators& control, const Air& air,
                 double dt) const;
  void short_step(VehicleState& state, const Actuators& control, const Air& air,
                  double dt) const;

  FixedWingModel model_;
  GroundContactParameters ground_;
  std::optional<HandLaunch> hand_launch_;
  double stiffness_;  // of the fastest aerodynamic reaction, per airspeed [1/m]
  FlightLimits limits_;
  FixedWingAirframe airframe_;
};

}  // namespace skein::asset
