// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/data/vehicle/vehicle_request.h"

namespace skein {

/// The near end of a link to a vehicle that is not simulated here.
///
/// Threads: called by one at a time; what is behind it has a thread of its own. No call
/// waits.
class VehiclePort {
 public:
  virtual ~VehiclePort() = default;

  /// Before the run, by the thread that runs it: starts the vehicle's program, if it has
  /// one that is ours.
  /// Fails: what cannot be started.
  virtual Result<void> open() { return {}; }

  /// Appends what the vehicle has said since the last call, in order; its times are of
  /// the run's clock and not after `now`.
  virtual void receive(Time now, std::vector<VehicleReport>& out) = 0;

  /// Puts a request to the vehicle; nothing while the link is down.
  /// @param number  comes back in a RequestAnswer; 0: none is wanted.
  virtual void send(std::uint32_t number, const VehicleRequest& request) = 0;
};

}  // namespace skein
