// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/result.h"
#include "skein/data/vehicle/airframe.h"
#include "skein/data/vehicle/fault.h"
#include "skein/scenario/scenario.h"

namespace skein::assemble {

/// The parts of one aircraft that can fail, by the names that a scenario gives them.
struct Parts {
  Airframe airframe;
  std::vector<std::string> sensors;  ///< kinds of the autopilot's, in their order
  std::vector<std::string> payload;  ///< kinds of the agent's, in their order
};

/// Every part of an aircraft that a command can make fail, once each.
std::vector<VehicleFault> breakable_parts(const Parts& parts);

/// What will fail on aircraft `index` of a group: what the scenario says, and what chance
/// adds, in the order of time.
///
/// Fails: kBadInput for a part that the aircraft does not have; says which it has.
Result<std::vector<VehicleFault>> vehicle_faults(const scenario::AircraftGroup& group,
                                                 int index, const Parts& parts,
                                                 Time duration, std::uint64_t seed,
                                                 EntityId entity);

}  // namespace skein::assemble
