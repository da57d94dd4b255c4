// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

namespace skein {

/// What the sensors of an autopilot feel at the end of a physics step, without errors.
struct SensedMotion {
  Time time;                     ///< of the run's clock
  double dt = 0;                 ///< length of the step [s]
  Vec3 p_N = Vec3::Zero();       ///< [m]
  Vec3 v_N = Vec3::Zero();       ///< over ground [m/s]
  Quat q_NB = Quat::Identity();  ///< attitude
  Vec3 w_NB_B = Vec3::Zero();    ///< rate of turn [rad/s]
  Vec3 f_B = Vec3::Zero();       ///< specific force: acceleration less gravity [m/s^2]
  double airspeed = 0;           ///< true [m/s]
  double height_agl = 0;         ///< [m]
  Energy energy;
};

/// An autopilot outside of Skein that moves a plant here: it is given what its sensors
/// feel, and says what the actuators do.
///
/// Threads: one at a time.
class AutopilotDrive {
 public:
  virtual ~AutopilotDrive() = default;

  /// Opens ports and starts programs, before the run. Programs end with the thread that
  /// calls.
  /// Fails: what cannot be opened or started.
  virtual Result<void> open() { return {}; }

  /// It drives by the wall clock, and so must the run.
  virtual bool real_time() const { return false; }

  /// The plant moves from `now` on, or again.
  virtual void begin(Time /*now*/) {}

  /// Between steps of the run, by the thread of open(): looks after its program.
  virtual void look_after(Time /*now*/) {}

  /// One physics step: hands over what is felt at its end, and waits, for a bounded time,
  /// for what the actuators are to do in the next.
  /// @param channels  as in Actuators, finite and within their ranges; written only when
  ///                  it answers.
  /// @returns  whether it has answered.
  virtual bool exchange(const SensedMotion& motion, std::span<float> channels) = 0;

  /// Appends what has happened up to the step of the run at `now`.
  virtual void take_events(Time now, std::vector<OutsideEvent>& out) = 0;
};

}  // namespace skein
