#pragma once

#include <cstdint>

#include "skein/link/mavlink/constants.h"
#include "skein/link/vehicle_services/served_vehicle.h"

namespace skein::vehicle_services {

/// How far a take-off has come, by the altitude.
class TakeOffProgress {
 public:
  struct State {
    mavlink::CommandResult result = mavlink::CommandResult::kInProgress;
    std::uint8_t percent = 0;
  };

  TakeOffProgress(const ServedVehicle& vehicle, double target_msl);

  /// Accepted when it is nearly there, or when the vehicle has ended the take-off not far
  /// below; cancelled when it shall do something else; failed when it is disarmed, has
  /// ended the take-off early, or needs more than three minutes of the run.
  State check(const ServedVehicle& vehicle);

 private:
  double start_msl_, target_msl_;
  Time began_;  // of the run
  bool seen_ = false;
};

}  // namespace skein::vehicle_services
