// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "skein/data/event/record.h"
#include "skein/link/vehicle_links/vehicle_links.h"

namespace skein::vehicle_links {

/// Tells real vehicles of a run's simulated aircraft: where those believe to be, as often
/// as that is recorded.
class TrafficFeed {
 public:
  /// @param links  outlives it.
  /// @param names  of the simulated aircraft, as the scenario has them.
  TrafficFeed(VehicleLinks& links, const std::vector<std::string>& names);

  void hear(const EntityRecord& record);
  void hear(const EstimateRecord& record);
  /// The step of the run at `time` is done.
  void publish(Time time);

 private:
  VehicleLinks& links_;
  std::map<std::string, std::size_t> numbers_;
  std::map<EntityId, std::size_t> by_entity_;
  std::vector<SimulatedTraffic> where_;  // since the last step
};

}  // namespace skein::vehicle_links
