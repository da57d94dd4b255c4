// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/airframe.h"
#include "skein/data/vehicle/control.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein {

/// Where and how a vehicle begins.
struct VehicleStart {
  Vec3 p_N = Vec3::Zero();     ///< [m]
  double heading = 0;          ///< [rad]
  Vec3 wind_N = Vec3::Zero();  ///< there [m/s]
  bool on_ground = false;      ///< at rest; else in level flight at cruise (or hovering)
  bool held = false;           ///< on the ground, by a crew, until it is to move
};

/// How touching the ground ends.
enum class Contact {
  kRests,  ///< it stands or slides on the ground
  kCrash,  ///< it is broken
};

/// Flight dynamics of one kind of vehicle. Holds parameters only: whatever changes in
/// flight is in VehicleState, so one const plant may serve many vehicles and threads.
class Plant {
 public:
  virtual ~Plant() = default;

  virtual FlightLimits limits() const = 0;

  /// What an autopilot of this plant is set up for; says which Control it takes.
  virtual Airframe airframe() const = 0;

  virtual VehicleState start(const VehicleStart& start) const = 0;

  /// Moves `state` on by `dt` [s] under a constant control and constant air. The state
  /// stays finite, or says by not being finite that it has left what the model covers.
  virtual void step(VehicleState& state, const Control& control, const Air& air,
                    double dt) const = 0;

  /// The vehicle is at or below the ground, at `ground_msl` [m]: what the ground does to
  /// it in the next `dt` [s]. After kRests it is on the ground.
  virtual Contact touch(VehicleState& state, double ground_msl, double dt) const = 0;
};

}  // namespace skein
