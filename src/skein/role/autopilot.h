// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/control.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein {

/// Flies one vehicle: estimates its state from sensors and follows commands. Never sees
/// the truth.
class Autopilot {
 public:
  virtual ~Autopilot() = default;

  /// The flight begins (again): from here on, knowing only where and how.
  virtual void begin(const NavEstimate& start, bool on_ground) = 0;

  /// Takes in one sample of the vehicle's own sensors. Those of no use to it are passed
  /// over.
  virtual void sense(const SensorSample& sample) = 0;

  /// Replaces what to do next.
  virtual void command(const AutopilotCommand& command) = 0;

  /// Replaces where returns lead. Holds for a return under way, and until the next call;
  /// a landing that is nearly down goes on.
  virtual void set_return(const ReturnRoute& route) = 0;

  /// The control for the next `dt` [s], from the estimate carried on to `now`.
  virtual Control control(Time now, double dt) = 0;

  /// The estimate at the last control().
  virtual NavEstimate estimate() const = 0;
  virtual AutopilotStatus status() const = 0;
};

}  // namespace skein
