// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/vehicle/control.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/geo/vec.h"

namespace skein {

/// The flight model of a vehicle in another program, whose autopilot is here: it is given
/// what the actuators do, and says how the vehicle moves. It goes by the wall clock.
///
/// Threads: one at a time; what is behind it has a thread of its own.
class FlightModel {
 public:
  virtual ~FlightModel() = default;

  /// Opens ports and starts its program, before the run, and waits for it. Its program
  /// ends with the thread that calls.
  /// Fails: what cannot be opened or started; its program has ended.
  virtual Result<void> open() { return {}; }

  /// Between steps of the run, by the thread of open(): appends what has come up since
  /// the last call. How it moves (VehicleMotion), only the newest, by the run's clock;
  /// VehicleCondition when that has changed; LinkChange::kRebooted when it has begun
  /// anew, before its first motion after that; what has become of its program.
  virtual void receive(Time now, std::vector<VehicleReport>& out) = 0;

  /// What the actuators are to do from now on. Does not wait.
  /// @param wind_N  of the air there, for programs that are given it [m/s].
  virtual void send(const Actuators& actuators, const Vec3& wind_N) = 0;
};

}  // namespace skein
