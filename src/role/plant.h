#pragma once

#include "data/vehicle.h"

namespace skein {

/// Flight dynamics of one kind of vehicle. Holds parameters only: whatever changes in
/// flight is in VehicleState, so one const plant may serve many vehicles and threads.
class Plant {
 public:
  virtual ~Plant() = default;

  virtual FlightLimits limits() const = 0;

  /// The state `dt` [s] later under a constant command and constant air.
  virtual VehicleState step(const VehicleState& state, const FlightCommand& command,
                            const Air& air, double dt) const = 0;
};

}  // namespace skein
