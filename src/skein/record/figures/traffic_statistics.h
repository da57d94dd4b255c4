// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "skein/data/event/record.h"
#include "skein/data/traffic/separation.h"
#include "skein/record/figures/traffic_path.h"

namespace skein::record {

/// Other air traffic, and how well it was followed on board: the part of a run's key
/// figures that is about it. A run without traffic and without tracks has none.
class TrafficStatistics {
 public:
  void aircraft(const AirTraffic& what) { traffic_[what.id].address = what.address; }
  /// Of one aircraft in order of time.
  void motion(const TrafficMotion& motion) { traffic_[motion.traffic].path.add(motion); }
  /// Where an aircraft of ours is; after the motions until its time.
  void truth(Time time, EntityId id, const VehicleState& state);
  /// After the motions until its time.
  void belief(const TrafficBeliefRecord& record);

  /// Adds `traffic` (aircraft), `traffic_tracks` (that became firm, on all aircraft
  /// together), and of firm tracks once a second, to the nearest that sends the address
  /// of the track, else to the nearest of all: `traffic_error_rms_m`,
  /// `traffic_error_max_m` (horizontal), `traffic_vertical_error_rms_m`,
  /// `traffic_within_2_sigma` (the share whose horizontal error is below two standard
  /// deviations as believed), and `traffic_tracks_astray_s`: the seconds in which none is
  /// within 5 standard deviations and 100 m: they count in no other figure. Of aircraft
  /// that fly, by the truth: `traffic_near_collisions` and `traffic_well_clear_lost`, the
  /// encounters with one that was within 152.4 m and 30.48 m, or 609.6 m and 76.2 m; it
  /// is another encounter after a minute.
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  struct Flown {
    std::uint32_t address = 0;
    TrafficPath path;
  };
  struct Error {
    double horizontal = 0, vertical = 0;
  };
  Error nearest(const TrafficBeliefRecord& record, bool by_address) const;

  // Encounters that are counted once each.
  struct Encounters {
    Separation kept;
    std::map<std::pair<EntityId, std::uint32_t>, Time> last;
    std::uint64_t count = 0;
    void see(Time time, EntityId id, std::uint32_t traffic, const Vec3& apart);
  };

  std::map<std::uint32_t, Flown> traffic_;
  Encounters near_{*separation_named("nmac"), {}},
      lost_{*separation_named("well-clear"), {}};
  std::set<std::pair<EntityId, std::uint32_t>> firm_;
  double squared_ = 0, squared_vertical_ = 0, largest_ = 0;
  std::uint64_t compared_ = 0, within_ = 0, astray_ = 0;
};

}  // namespace skein::record
