#pragma once

#include <optional>
#include <span>

#include "layer/reasoning/agent/execution_monitor.h"
#include "layer/reasoning/agent/launch.h"
#include "layer/reasoning/agent/zone_watch.h"
#include "layer/reasoning/team/slot_plan.h"
#include "model/path/plan_curve.h"
#include "role/agent.h"
#include "role/terrain.h"

namespace skein::reasoning {

struct WingmanOptions {
  double altitude_agl = 120;  ///< flown above the highest ground of the route [m]
  double report_period = 1;   ///< between reports to the station [s]
  double horizon = 8;         ///< the way to the slot is planned for this long [s]
  ZoneGuardOptions guard;
  SafetyZone safety_zone;
};

/// The agent of an aircraft that flies in formation: it leads along a route, or keeps its
/// slot beside another aircraft, whichever task it heard of last. So roles can be swapped
/// in flight. It reports to the station once a second, and as leader to whom it is told.
/// On the ground it takes off first. As follower it stays out of no-flight zones; a
/// leader flies its route, and tells when that leads through one.
class Wingman final : public Agent {
 public:
  /// @param map    what it believes the ground to be; outlives the agent.
  /// @param zones  no-flight zones, copied.
  Wingman(const WingmanOptions& options, EntityId self, EntityId station,
          const FlightLimits& limits, const Terrain& map, std::span<const Zone> zones);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  void listen(const AgentInput& in, AgentOutput& out);
  void hear(const TeamPosition& told);
  void fly(const AgentInput& in, AgentOutput& out);
  void lead(const FlyRoute& route, AgentOutput& out) const;
  void follow(const FollowLeader& order, const AgentInput& in, AgentOutput& out);
  void report(const AgentInput& in, AgentOutput& out);

  WingmanOptions options_;
  EntityId self_, station_;
  FlightLimits limits_;
  const Terrain& map_;
  ExecutionMonitor execution_;
  ZoneWatch zones_;
  Launch launch_;

  Task task_;
  bool has_task_ = false, task_is_new_ = false, done_ = false;
  std::optional<LeaderMotion> leader_;
  // The last plan to the slot. The next one goes on at its height: one that began at the
  // aircraft's own would never call back what gusts have carried off.
  std::optional<model::PlanCurve> demanded_;
  Time next_report_;
};

}  // namespace skein::reasoning
