// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/role/vehicle.h"
#include "skein/role/vehicle_port.h"

namespace skein::mixed {

/// Makes the exclusion fence of an outside autopilot out of the no-fly zones in force:
/// its own fence is replaced when its link comes up, and whenever other zones count.
///
/// A fence has no altitudes. So a zone counts only from the time on when it is in force,
/// and while the vehicle is within 100 m of its altitudes.
class FenceKeeper {
 public:
  /// @param zones  in force from the start.
  explicit FenceKeeper(std::span<const Zone> zones) { set_zones(zones); }

  /// Replaces the zones in force.
  void set_zones(std::span<const Zone> zones);

  /// What the vehicle has said of its link.
  void hear(const LinkChange& change);
  void hear(const RequestAnswer& answer, Time now, std::vector<VehicleEvent>& events);

  /// Once a step of the run: uploads what has changed, not more than once in 5 s.
  void step(Time now, double altitude_msl, VehiclePort& port);

 private:
  // Of its requests; those of FlightDirector are numbered from 1.
  static constexpr std::uint32_t kFirstNumber = 0x8000'0000;

  void choose(Time now, double altitude_msl);

  std::vector<Zone> zones_;
  std::vector<bool> counts_;  // of each
  bool up_ = false;
  bool changed_ = true;  // since the last upload
  bool supported_ = true;
  std::uint32_t number_ = kFirstNumber, pending_ = 0;
  std::size_t uploaded_ = 0;  // zones, by the request that is pending
  Time again_at_;
  std::string refused_;  // the last reason, reported once
};

}  // namespace skein::mixed
