#pragma once

#include <optional>
#include <span>

#include "skein/data/path.h"
#include "skein/layer/reasoning/agent/edge_follower.h"
#include "skein/layer/reasoning/agent/execution_monitor.h"
#include "skein/layer/reasoning/agent/launch.h"
#include "skein/layer/reasoning/agent/return_planner.h"
#include "skein/layer/reasoning/agent/zone_monitor.h"
#include "skein/role/agent.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

struct MonitorAgentOptions {
  double altitude_agl = 120;  ///< flown above the ground ahead [m]
  double report_period = 1;   ///< between reports to the coordinator [s]
  double replan_wind = 2;     ///< change of the wind estimate that re-plans a path [m/s]
  double replan_cross = 60;   ///< distance off a path that re-plans it [m]
  EdgeFollowerOptions edge;
  /// Between course and edge, whatever the order says [rad]; none: the order's.
  std::optional<double> edge_angle;
  ZoneAvoidanceOptions avoidance;
  SafetyZone safety_zone;
};

/// The agent on board of an aircraft that watches a fire.
///
/// It sends every fire reading, placed by the estimated position, and a report each
/// second to the coordinator, and flies the newest task it has received; without messages
/// it goes on with the last. Whatever it flies stays out of the no-fly zones and above
/// the ground of its map. On the ground it takes off first, as long as no zone forbids
/// it; before the first task it circles where it is. When the place of a task, to fly to
/// or to circle, lies in a zone, the nearest place where it can circle takes its place,
/// named in an event "task-moved".
class MonitorAgent final : public Agent {
 public:
  /// @param coordinator  who gets its reports.
  /// @param map          what it believes the ground to be; outlives the agent.
  /// @param zones        no-fly zones in force from the start, copied.
  MonitorAgent(const MonitorAgentOptions& options, EntityId self, EntityId coordinator,
               const FlightLimits& limits, const Terrain& map,
               std::span<const Zone> zones);

  void step(const AgentInput& in, AgentOutput& out) override;

  const Task& task() const { return task_; }
  bool task_done() const { return done_; }

 private:
  // What the task wants flown, and its course over ground just ahead.
  struct Setpoint {
    decltype(AutopilotCommand::guidance) guidance;
    double course = 0;
  };

  void take_task(const Task& task, const AgentInput& in, AgentOutput& out);
  void take_samples(const AgentInput& in, AgentOutput& out);
  void report(const AgentInput& in, AgentOutput& out);

  Setpoint next_setpoint(const AgentInput& in, AgentOutput& out);
  Setpoint fly_to(const Vec2& point, const AgentInput& in);
  Setpoint follow_edge(const AgentInput& in, AgentOutput& out);
  Setpoint follow_line(const FollowLine& order, const AgentInput& in);
  Setpoint circle_at(const Vec2& centre, const NavEstimate& nav) const;
  Vec2 allowed(const Vec2& place, const AgentInput& in, AgentOutput& out);

  MonitorAgentOptions options_;
  EntityId self_, coordinator_;
  FlightLimits limits_;
  const Terrain& map_;
  ZoneMonitor zones_;
  ReturnPlanner returns_;
  ExecutionMonitor execution_;
  Launch launch_;

  Task task_;
  bool has_task_ = false, done_ = false;
  std::optional<Vec2> home_;   // circled before the first task
  std::optional<Vec2> moved_;  // where the task's place has been moved to
  double altitude_msl_ = 0;    // commanded [m]
  std::optional<Time> next_report_;

  Path path_;                      // of FlyTo, and the line of FollowLine
  Vec2 path_wind_ = Vec2::Zero();  // that it was planned for
  double along_ = 0;
  bool joined_ = false;     // FollowLine: its first point has been reached
  bool deflected_ = false;  // by the zone avoidance, at the last step
  std::optional<EdgeFollower> follower_;
  bool lost_ = false;
};

}  // namespace skein::reasoning
