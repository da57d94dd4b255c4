// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/asset/body/rigid_body.h"
#include "skein/layer/asset/fixed_wing/aerodynamics.h"
#include "skein/layer/asset/fixed_wing/engine.h"
#include "skein/layer/asset/fixed_wing/parameters.h"

namespace skein::asset {

/// The physics of one fixed wing, made ready for computing: what plant, trim, linear
/// model and open-loop flight share.
struct FixedWingModel {
  explicit FixedWingModel(const FixedWingParameters& parameters)
      : body(parameters.mass, parameters.inertia),
        aero(parameters.geometry, parameters.aero, parameters.stall),
        engine(parameters.propulsion),
        thrust_above(parameters.thrust_above),
        servos(parameters.servos),
        envelope(parameters.envelope),
        wing_area(parameters.geometry.area) {}

  /// All forces and moments but gravity.
  [[gnu::always_inline]] Wrench loads(const Flow& flow, const Vec3& w_AB_B,
                                      const Surfaces& surfaces, double density,
                                      const Engine::Output& engine_output) const {
    Wrench wrench = aero.loads(flow, w_AB_B, surfaces, density);
    wrench.force_B.x() += engine_output.thrust;
    wrench.moment_B.x() -= engine_output.torque;
    wrench.moment_B.y() -= thrust_above * engine_output.thrust;
    return wrench;
  }

  RigidBody body;
  Aerodynamics aero;
  Engine engine;
  double thrust_above;
  Servos servos;
  Envelope envelope;
  double wing_area;  ///< [m^2]
};

}  // namespace skein::asset
