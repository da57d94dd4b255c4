#pragma once

#include <memory>
#include <optional>
#include <span>

#include "skein/layer/reasoning/agent/execution_monitor.h"
#include "skein/layer/reasoning/agent/launch.h"
#include "skein/layer/reasoning/agent/return_planner.h"
#include "skein/layer/reasoning/agent/route_flight.h"
#include "skein/layer/reasoning/agent/zone_monitor.h"
#include "skein/layer/reasoning/team/slot_plan.h"
#include "skein/model/path/plan_curve.h"
#include "skein/role/agent.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

struct WingmanOptions {
  double altitude_agl = 120;  ///< flown above the highest ground of the route [m]
  double report_period = 1;   ///< between reports to the station [s]
  double horizon = 8;         ///< the path to the slot is planned for this long [s]
  ZoneAvoidanceOptions avoidance;
  SafetyZone safety_zone;
};

/// The agent of an aircraft that flies in formation: it leads along a route, or keeps its
/// slot beside another aircraft, whichever task it received last. So roles can be swapped
/// in flight. It reports to the station once a second, and as leader to those named in
/// its task. On the ground it takes off first, as long as no no-fly zone forbids it. It
/// stays out of zones: as leader it flies around those on its route (RouteFlight).
class Wingman final : public Agent {
 public:
  /// @param map    what it believes the ground to be; outlives the agent.
  /// @param zones    no-fly zones in force from the start, copied.
  /// @param planner  of routes around zones; null: none.
  Wingman(const WingmanOptions& options, EntityId self, EntityId station,
          const FlightLimits& limits, const Terrain& map, std::span<const Zone> zones,
          std::shared_ptr<const PathPlanner> planner = nullptr);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  void listen(const AgentInput& in, AgentOutput& out);
  void hear(const TeamPosition& reported);
  void fly(const AgentInput& in, AgentOutput& out);
  void lead(const FlyRoute& route);
  void follow(const FollowLeader& order, const AgentInput& in, AgentOutput& out);
  void report(const AgentInput& in, AgentOutput& out);

  WingmanOptions options_;
  EntityId self_, station_;
  FlightLimits limits_;
  const Terrain& map_;
  ExecutionMonitor execution_;
  ZoneMonitor zones_;
  ReturnPlanner returns_;
  std::shared_ptr<const PathPlanner> planner_;
  Launch launch_;
  std::optional<Vec2> home_;

  Task task_;
  bool has_task_ = false, task_is_new_ = false, done_ = false;
  std::optional<RouteFlight> route_;  // of a leader
  std::optional<LeaderMotion> leader_;
  // The last plan to the slot. The next one goes on at its height: one that began at the
  // aircraft's own would never call back what gusts have carried off.
  std::optional<model::PlanCurve> demanded_;
  Time next_report_;
};

}  // namespace skein::reasoning
