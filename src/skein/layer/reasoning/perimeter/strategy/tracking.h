// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "skein/layer/reasoning/perimeter/strategy/boundary_line.h"
#include "skein/role/monitoring_strategy.h"

namespace skein::perimeter {

struct TrackingOptions {
  double edge_angle = geo::radians(35);  ///< real edge: between course and edge [rad]
  /// Which edge is followed: the predicted one, or the real one, found with the sensors
  /// on board (in/out zig-zag, or an ideal edge finder where the aircraft has one).
  bool predicted = false;
  bool clockwise = true;     ///< on the map
  double look_ahead = 1500;  ///< predicted: length of the line that is ordered [m]
  double renew_period = 10;  ///< predicted: the line follows the belief this often [s]
};

/// Aircraft, evenly spaced, fly along the edge of the fire: the thesis's benchmark.
/// Reference: [Rabinovich18] section 5.3.
class TrackingStrategy : public MonitoringStrategy {
 public:
  explicit TrackingStrategy(const TrackingOptions& options);

  std::vector<Assignment> assign(const MonitoringSituation& situation) override;

 private:
  TrackingOptions options_;
  std::map<EntityId, Time> given_;
};

/// Where each of `count` evenly spaced aircraft begins on the line, so that they fly as
/// little as possible: a boundary point per aircraft.
std::vector<std::size_t> even_starts(const BoundaryLine& line,
                                     std::span<const AircraftStatus> aircraft);

}  // namespace skein::perimeter
