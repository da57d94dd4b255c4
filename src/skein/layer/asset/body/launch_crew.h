// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/asset/body/parameter_error.h"
#include "skein/role/plant.h"

namespace skein::asset {

/// How a crew throws an aircraft that has no wheels.
struct HandLaunch {
  double speed = 9;     ///< over ground, as it leaves the hand [m/s]
  double pitch = 0.26;  ///< of nose and throw, above the horizon [rad]
  double height = 1.8;  ///< above ground, of the hand that holds it [m]
  double reach = 1.5;   ///< way over which it is pushed [m]
};

/// What must hold for these.
std::vector<ParameterError> errors(const HandLaunch& launch);

/// What the crew does in one step to an aircraft that it holds (VehicleState::held).
///
/// It stands still, whatever the wind, until its motor is given power: half of it, or for
/// a throw nearly all. Then it is let go at once, or first pushed along its nose in the
/// attitude in which it is held, with speed^2 / (2 reach). It is thrown when the air is
/// calm or blows from ahead, not from aside or behind: until then the crew waits.
///
/// @param throttle  commanded, from 0 to 1.
/// @param wind_N    at the aircraft, gusts included [m/s].
/// @returns         whether it is still in its hands: then position and velocity have
///                  been moved on by `dt` [s].
bool hold(const std::optional<HandLaunch>& launch, VehicleState& state, double throttle,
          const Vec3& wind_N, double dt);

}  // namespace skein::asset
