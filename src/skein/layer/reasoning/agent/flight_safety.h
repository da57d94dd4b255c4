// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "skein/layer/reasoning/agent/launch.h"
#include "skein/layer/reasoning/trajectory/execution_monitor.h"
#include "skein/layer/reasoning/trajectory/return_planner.h"
#include "skein/layer/reasoning/trajectory/zone_monitor.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

/// What every flight needs, whatever its task: learns of no-fly zones and plans returns
/// around them, takes off, and watches how plans are carried out.
///
/// In each step an agent calls listen(); as long as there is a navigation estimate
/// may_fly(), then its planners where the answer is yes, and finish().
class FlightSafety {
 public:
  /// @param zones  no-fly zones in force from the start, copied.
  /// @param map    the ground as believed; outlives this.
  FlightSafety(const ZoneAvoidanceOptions& avoidance, const SafetyZone& safety_zone,
               EntityId self, const FlightLimits& limits, const Terrain& map,
               std::span<const Zone> zones)
      : zones_(avoidance, limits, zones, self),
        returns_(avoidance, limits, self, map),
        execution_(safety_zone),
        self_(self) {}

  /// How fast it flies and turns from now on.
  void set_limits(const FlightLimits& limits) {
    zones_.set_limits(limits);
    returns_.set_limits(limits);
  }

  /// Takes in changes of zones. Works without a navigation estimate too.
  void listen(const AgentInput& in, AgentOutput& out) { news_ = zones_.listen(in, out); }

  /// Plans returns, and takes an aircraft that stands on the ground up to an altitude
  /// unless a zone forbids it.
  /// @param may_stand  what it is to fly lets it stand on the ground.
  /// @returns  whether it may be commanded: else it stands, or takes off.
  bool may_fly(const AgentInput& in, double altitude_msl, bool may_stand,
               AgentOutput& out);

  /// Another task has come: an aircraft that has landed takes off again for it.
  void allow_launch(const AgentInput& in) { launch_.allow(in); }

  /// Reports zones that are entered or avoided, and plans that are left.
  void finish(const AgentInput& in, AgentOutput& out);

  /// Where the first step found the aircraft; home of its returns. Needs a may_fly().
  const Vec2& home() const { return *home_; }

  /// The aircraft stood on the ground then. Needs a may_fly().
  bool began_on_ground() const { return began_on_ground_; }

  /// Other zones are in force since this step.
  bool news() const { return news_; }

  /// The flight of a plan or path has left its safety zone.
  bool off_plan() const { return execution_.off_plan(); }

  ZoneMonitor& zones() { return zones_; }
  const ReturnPlanner& returns() const { return returns_; }

 private:
  ZoneMonitor zones_;
  ReturnPlanner returns_;
  ExecutionMonitor execution_;
  Launch launch_;
  EntityId self_;
  std::optional<Vec2> home_;
  bool news_ = false, began_on_ground_ = false;
};

}  // namespace skein::reasoning
