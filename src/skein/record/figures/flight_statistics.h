// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/event/event.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/geo/vec.h"
#include "skein/record/figures/position_error.h"

namespace skein::record {

/// How well a run's aircraft flew: the part of its key figures that is about flight.
class FlightStatistics {
 public:
  void truth(Time time, EntityId id, const VehicleState& state);
  /// @param cross_track  of the path that it follows; none when it follows nothing [m].
  void estimate(Time time, EntityId id, const Vec3& p_N,
                std::optional<double> cross_track);
  /// @param reserve  charge less what it takes to get home, from 0 to 1; 1 while nothing
  ///                 is known of it.
  void reserve(EntityId id, double reserve);
  void event(const Event& event);

  /// Adds `accidents`, `failsafes` (how often one began to act), `aircraft_landed` (that
  /// stand on the ground in the end, having flown, without an accident; where none does
  /// it is left out), and where there is something to say `cross_track_rms_m`,
  /// `position_error_rms_m` (horizontal, of the estimates against the truth of their
  /// times), `outside_programs_ended` and `outside_programs_gone` (that ended by
  /// themselves, and those of them that were not there in the end) and `min_charge`. Per
  /// aircraft, by its name, `min_reserve_<name>` once something was known of it.
  void add_figures(std::map<std::string, double>& figures,
                   const std::function<std::string(EntityId)>& name_of) const;

 private:
  void failsafe(const Event& event);

  struct Square {
    double sum = 0, count = 0;
    void add(double square) {
      sum += square;
      count += 1;
    }
  };
  Square cross_track_;
  PositionError position_error_;
  std::optional<double> min_charge_;
  std::map<EntityId, double> min_reserve_;
  std::map<EntityId, bool> acting_;  // a failsafe
  std::set<EntityId> flown_, broken_;
  std::map<EntityId, Time> landed_;  // when it touched the ground last
  std::uint64_t accidents_ = 0, failsafes_ = 0;
  std::uint64_t programs_ended_ = 0;
  std::set<EntityId> gone_;  // whose program has ended
};

}  // namespace skein::record
