#pragma once

#include <vector>

#include "layer/reasoning/agent/execution_monitor.h"
#include "role/agent.h"
#include "role/terrain.h"

namespace skein::reasoning {

struct RouteAgentOptions {
  std::vector<Vec2> points = {{0, 0}, {400, 0}, {400, 400}, {0, 400}};  ///< [m]
  int laps = 3;                                                         ///< times round
  double altitude_agl = 120;  ///< flown above the highest ground of the route [m]
  double report_period = 1;   ///< between reports to the station [s]
  SafetyZone safety_zone;
};

/// Flies given points round and round, then stays at the last of them. It takes no
/// orders, and reports to the station where it is.
class RouteAgent final : public Agent {
 public:
  /// @param map  what it believes the ground to be.
  RouteAgent(const RouteAgentOptions& options, EntityId self, EntityId station,
             const FlightLimits& limits, const Terrain& map);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  RouteAgentOptions options_;
  EntityId self_, station_;
  FlightLimits limits_;
  double altitude_msl_;
  ExecutionMonitor execution_;
  bool begun_ = false, done_ = false;
  Time next_report_;
};

/// A ground station's agent that takes in what it is told and does nothing.
class Listener final : public Agent {
 public:
  void step(const AgentInput&, AgentOutput&) override {}
};

}  // namespace skein::reasoning
