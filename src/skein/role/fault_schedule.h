// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/vehicle/fault.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/vehicle.h"

namespace skein {

/// Which parts of one vehicle fail and when: as planned, and as commanded.
class FaultSchedule {
 public:
  /// What does not work.
  struct InForce {
    Faults plant;
    std::uint64_t sensors = 0;  ///< bit k: sensor k of the vehicle says nothing
    std::uint64_t payload = 0;  ///< bit k: payload sensor k says nothing
    bool link = false;          ///< no message goes in or out

    bool sensor_silent(std::size_t k) const { return (sensors >> k & 1u) != 0; }
    bool payload_silent(std::size_t k) const { return (payload >> k & 1u) != 0; }
  };

  /// @param breakable  all that can be made to fail, by name.
  FaultSchedule(std::vector<VehicleFault> planned, std::vector<VehicleFault> breakable)
      : faults_(std::move(planned)), breakable_(std::move(breakable)) {}

  /// Moves on to `now`, and appends what fails or works again.
  /// @returns  whether anything does.
  bool update(Time now, std::vector<VehicleEvent>& events);

  const InForce& in_force() const { return in_force_; }

  /// Makes a part fail from `now` on, or work again.
  /// Fails: kBadInput when there is no such part.
  Result<void> set(const std::string& vehicle, const std::string& part, bool fails,
                   Time now);

 private:
  void apply(const VehicleFault& fault);

  std::vector<VehicleFault> faults_, breakable_;
  std::vector<bool> active_;  // of each of the faults
  InForce in_force_;
};

}  // namespace skein
