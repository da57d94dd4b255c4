// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/traffic/separation.h"
#include "skein/geo/vec.h"

namespace skein::record {

/// How near aircraft came to each other, by the truth.
///
/// Between two moments both move straight. A pair counts once for each measure, however
/// long or often it was too near.
///
/// Cost: sorted by north, N log N a moment for aircraft that are spread out.
class SeparationMeter {
 public:
  /// @param kept  whose violations are counted, by who keeps no other.
  explicit SeparationMeter(const Separation& kept);

  /// An aircraft keeps another separation; a pair the larger of both.
  void keeps(EntityId id, const Separation& kept);

  /// Where an aircraft is; moments in order of time. On the ground, and while it jumps
  /// there, it is not to be kept apart from.
  void place(Time time, EntityId id, const Vec3& p_N, bool on_ground = false);

  /// It takes no further part.
  void remove(EntityId id) { last_.erase(id); }

  /// Looks at the last moment too.
  void finish();

  double min_ratio() const { return min_ratio_; }  ///< 1e9 when no two were near
  double min_horizontal() const { return min_horizontal_; }      ///< [m], where it counts
  std::size_t violations() const { return violations_.size(); }  ///< pairs
  std::size_t near_collisions() const { return near_collisions_.size(); }
  std::size_t well_clear_lost() const { return well_clear_lost_.size(); }

 private:
  struct Place {
    EntityId id;
    Vec3 from, to;
    Separation kept;
  };
  using Pair = std::pair<EntityId, EntityId>;
  void look();
  void look(const Place& a, const Place& b);

  Separation kept_;
  double near_;  // all that is counted happens nearer [m]
  Time time_;
  bool begun_ = false;
  std::map<EntityId, Separation> others_;  // by who keeps another
  std::map<EntityId, Time> touched_;       // the ground last
  std::map<EntityId, Vec3> last_;
  std::vector<std::pair<EntityId, Vec3>> now_;
  std::vector<Place> places_;
  double min_ratio_ = 1e9, min_horizontal_ = 1e9;
  std::set<Pair> violations_, near_collisions_, well_clear_lost_;
};

}  // namespace skein::record
