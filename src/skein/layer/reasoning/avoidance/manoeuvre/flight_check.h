// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "skein/data/airspace/airspace.h"
#include "skein/role/path_planner.h"
#include "skein/solve/path/airspace_map.h"

namespace skein::reasoning {

/// Whether no-fly zones and ground leave flights free. Makes what it looks into when it
/// is asked first.
class FlightCheck {
 public:
  /// @param query  ground and clearance count; outlives this, as the zones do.
  FlightCheck(const PathQuery& query, std::span<const Zone> zones)
      : query_(query), zones_(zones) {}

  bool is_free(const FlightPlan& flight) {
    if (!map_) {
      airspace_.zones.assign(zones_.begin(), zones_.end());
      query_.airspace = &airspace_;
      map_ = std::make_unique<solve::AirspaceMap>(query_);
    }
    return map_->is_free(flight);
  }

 private:
  PathQuery query_;
  std::span<const Zone> zones_;
  Airspace airspace_;
  std::unique_ptr<solve::AirspaceMap> map_;
};

}  // namespace skein::reasoning
