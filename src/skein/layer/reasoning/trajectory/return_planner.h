// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/agent_step.h"
#include "skein/layer/reasoning/trajectory/detour_planner.h"
#include "skein/layer/reasoning/trajectory/zone_avoidance.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

/// Plans returns out of no-fly zones: the autopilot's failsafes fly home without asking
/// the agent, so it is given beforehand where to, and by what route.
///
/// Home stays where it is while a circle around it, with the margin, touches no zone;
/// else the nearest place with such a circle takes its place, named in an event
/// "return-moved". For the place zones count that forbid any altitude from the ground to
/// that of the flight, for the route those at the altitude of the flight, 60 m above home
/// at least; both until ten minutes from now. Routes bend so far from zones that the
/// aircraft can circle there.
class ReturnPlanner {
 public:
  /// @param map  the ground as it is believed to be; outlives this.
  ReturnPlanner(const ZoneAvoidanceOptions& options, const FlightLimits& limits,
                EntityId self, const Terrain& map)
      : options_(options), avoidance_(options, limits, {}), self_(self), map_(map) {}

  /// It flies and turns so from now on.
  void set_limits(const FlightLimits& limits) { avoidance_.set_limits(limits); }

  /// To be called at each step; works once a second, and at once when zones come and go.
  /// Needs in.nav.
  ///
  /// @param home     where returns lead without zones.
  /// @param zones    in force.
  /// @param changed  they are others than at the last step.
  void step(const AgentInput& in, const Vec2& home, std::span<const Zone> zones,
            bool changed, AgentOutput& out);

  /// Where to land instead of at `place`, as home is moved: the same place, if it may be.
  Vec2 allowed(const Vec2& place) const {
    return places_ ? places_->nearest_allowed(place) : place;
  }

 private:
  struct Counting {
    std::vector<bool> place, route;  // of the zones
    bool operator==(const Counting&) const = default;
  };
  Counting count(const AgentInput& in, const Vec2& home,
                 std::span<const Zone> zones) const;
  void draw(std::span<const Zone> zones, double clearance);
  void move_home(const AgentInput& in, const Vec2& home, AgentOutput& out);
  bool still_good(const Vec2& here, const Vec2& goal) const;
  bool is_behind(const Vec2& here, const Vec2& corner, const Vec2& next) const;

  ZoneAvoidanceOptions options_;
  ZoneAvoidance avoidance_;
  EntityId self_;
  const Terrain& map_;
  Time next_;
  Counting counting_;
  double clearance_ = 0;
  std::optional<DetourPlanner> places_, detours_,
      narrow_;  // narrow: with the margin only
  std::optional<Vec2> moved_;
  ReturnRoute reported_;
};

}  // namespace skein::reasoning
