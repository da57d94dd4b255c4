// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/mixed/fence_keeper.h"
#include "skein/role/vehicle.h"
#include "skein/role/vehicle_port.h"

namespace skein::mixed {

/// Which obstacles of the virtual world a real vehicle is told of.
struct ObstacleFeed {
  double range = 100;  ///< [m]
  double rate = 5;     ///< [Hz]
  bool zones = false;  ///< no-fly zones are walls
};

/// A position that a real vehicle is given in place of a satellite receiver's.
struct FixFeed {
  /// The vehicle that is where this one is to believe itself to be, or null. Called
  /// between steps, when no vehicle moves.
  std::function<const Vehicle*()> source;
  double rate = 5;  ///< [Hz]
};

/// What a real vehicle is sent of the virtual world, but for traffic.
struct VirtualFeedOptions {
  std::optional<ObstacleFeed> obstacles;
  bool fence = false;  ///< no-fly zones become its exclusion fence
  std::optional<FixFeed> fix;
  std::vector<Zone> zones;  ///< in force from the start
};

/// Sends it, in the simulation's thread.
class VirtualFeeds {
 public:
  explicit VirtualFeeds(VirtualFeedOptions options);

  void set_zones(std::span<const Zone> zones);

  void hear(const LinkChange& change);
  void hear(const RequestAnswer& answer, Time now, std::vector<VehicleEvent>& events);

  /// Between steps: where the source of its position is.
  void look(Time now);

  /// Once a step of the run: sends what is due.
  /// @param motion  of the vehicle; null while nobody knows where it is.
  void step(const Surroundings& world, Time now, const VehicleMotion* motion,
            bool on_ground, VehiclePort& port);

 private:
  VirtualFeedOptions options_;
  std::optional<FenceKeeper> fence_;
  std::optional<PositionFix> fix_;  // to be sent
  Time obstacles_due_, fix_due_;
};

}  // namespace skein::mixed
