// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

#include "skein/data/vehicle/vehicle_request.h"

namespace skein::vehicle_services {

/// What is asked for, until the simulation takes it. A setpoint that comes again before
/// the last was taken replaces it; of the rest there is room for so many.
class RequestQueue {
 public:
  static constexpr std::size_t kMaxWaiting = 64;

  /// @returns  false when there is no room.
  bool add(VehicleRequest request) {
    if (is_setpoint(request)) {
      for (auto last = waiting_.rbegin(); last != waiting_.rend() && is_setpoint(*last);
           ++last)
        if (last->index() == request.index()) {
          *last = std::move(request);
          return true;
        }
    }
    if (waiting_.size() >= kMaxWaiting) return false;
    waiting_.push_back(std::move(request));
    return true;
  }

  bool has_room(std::size_t count) const {
    return waiting_.size() + count <= kMaxWaiting;
  }

  std::vector<VehicleRequest> take() { return std::exchange(waiting_, {}); }

 private:
  static bool is_setpoint(const VehicleRequest& request) {
    return std::holds_alternative<BankSetpoint>(request) ||
           std::holds_alternative<TrackSetpoint>(request) ||
           std::holds_alternative<PilotRequest>(request);
  }

  std::vector<VehicleRequest> waiting_;
};

}  // namespace skein::vehicle_services
