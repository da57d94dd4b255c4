#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "skein/layer/reasoning/agent/execution_monitor.h"
#include "skein/layer/reasoning/agent/launch.h"
#include "skein/layer/reasoning/agent/position_report.h"
#include "skein/layer/reasoning/agent/return_planner.h"
#include "skein/layer/reasoning/agent/route_flight.h"
#include "skein/layer/reasoning/agent/zone_monitor.h"
#include "skein/role/agent.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

struct RouteAgentOptions {
  std::vector<Vec2> points = {{0, 0}, {400, 0}, {400, 400}, {0, 400}};  ///< [m]
  int laps = 3;                                                         ///< times around
  double altitude_agl = 120;  ///< flown above the highest ground of the route [m]
  double report_period = 1;   ///< between reports to the station [s]
  bool lands = false;         ///< after the last lap
  SafetyZone safety_zone;
  ZoneAvoidanceOptions avoidance;
};

/// Flies given points lap after lap, then stays at the last of them, or lands: where it
/// took off or, when it began in the air, at the first of them. It takes no orders, and
/// reports to the station where it is. On the ground it takes off first, as long as no
/// no-fly zone forbids it. It flies around zones (RouteFlight), and reports when it is in
/// one.
class RouteAgent final : public Agent {
 public:
  /// @param map    what it believes the ground to be; outlives the agent.
  /// @param zones    no-fly zones in force from the start, copied.
  /// @param planner  of routes around zones; null: none.
  RouteAgent(const RouteAgentOptions& options, EntityId self, EntityId station,
             const FlightLimits& limits, const Terrain& map, std::span<const Zone> zones,
             std::shared_ptr<const PathPlanner> planner = nullptr);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  void fly(const AgentInput& in, AgentOutput& out);
  void land(const AgentInput& in, AgentOutput& out);

  RouteAgentOptions options_;
  EntityId self_;
  FlightLimits limits_;
  const Terrain& map_;
  double altitude_msl_;
  ExecutionMonitor execution_;
  ZoneMonitor zones_;
  ReturnPlanner returns_;
  RouteFlight flight_;
  Launch launch_;
  std::optional<Vec2> start_;          // home of the autopilot
  Vec2 home_ = Vec2::Zero();           // where it lands
  std::optional<Vec2> landing_point_;  // where it has been commanded to
  bool done_ = false, land_again_ = false;
  PositionReport report_;
};

/// A ground station's agent that takes in what it receives and does nothing.
class Listener final : public Agent {
 public:
  void step(const AgentInput&, AgentOutput&) override {}
};

}  // namespace skein::reasoning
