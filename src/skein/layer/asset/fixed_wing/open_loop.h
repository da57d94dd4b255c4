// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "skein/layer/asset/fixed_wing/aerodynamics.h"
#include "skein/layer/asset/fixed_wing/model.h"

namespace skein::asset {

/// What acts on an aircraft at one time; linear in time between two of them.
struct OpenLoopInput {
  double t = 0;  ///< [s]
  Surfaces surfaces;
  double thrust = 0;           ///< along the body's forward axis [N]
  Vec3 wind_N = Vec3::Zero();  ///< [m/s]
};

/// How it flies then.
struct OpenLoopOutput {
  Motion motion;
  double alpha = 0;                      ///< [rad]
  double beta = 0;                       ///< [rad]
  double airspeed = 0;                   ///< [m/s]
  Vec3 specific_force_B = Vec3::Zero();  ///< aerodynamics and thrust over mass [m/s^2]
};

struct OpenLoopOptions {
  double longest_step = 0.005;  ///< of the integration [s]
  /// Gravity falls off with height as g0 (R/(R + h))^2; infinite: g0 everywhere [m].
  double planet_radius = std::numeric_limits<double>::infinity();
};

/// Flies an aircraft without autopilot, servos and motor: deflections and thrust are
/// given directly, without any limit. Integration steps are equal parts of each interval
/// between inputs, so the inputs are smooth within a step and times are hit exactly.
///
/// @param start   motion at the time of the first input; velocity over ground, in N.
/// @param inputs  at least one, in rising order of time.
/// @returns       one output for each input, at its time. Not finite where the flight
///                leaves what numbers can say.
std::vector<OpenLoopOutput> fly_open_loop(const FixedWingModel& model,
                                          const Motion& start,
                                          std::span<const OpenLoopInput> inputs,
                                          const OpenLoopOptions& options = {});

}  // namespace skein::asset
