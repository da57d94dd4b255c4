// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

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

  /// Accepted when it is nearly there; or when the vehicle has ended the take-off by
  /// holding or guided flight, and ten seconds later is not far below. Cancelled when it
  /// shall do something else. Failed when it is disarmed, ends the take-off otherwise or
  /// far below, or needs more than three minutes of the run.
  State check(const ServedVehicle& vehicle);

 private:
  double start_msl_, target_msl_;
  Time began_;                 // of the run
  bool seen_ = false;          // the vehicle was taking off
  std::optional<Time> ended_;  // since when it no longer is
};

}  // namespace skein::vehicle_services
