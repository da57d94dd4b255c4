#pragma once

#include <memory>
#include <optional>
#include <span>

#include "skein/layer/reasoning/agent/return_planner.h"
#include "skein/layer/reasoning/agent/zone_monitor.h"
#include "skein/role/agent.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

/// Keeps an agent that knows nothing of no-fly zones out of them: where its commands
/// would lead into one, the zone avoidance flies instead, and afterwards its last command
/// is given again. It does not take off into one. Its reports say which changes are
/// known.
class ZoneDecorator final : public Agent {
 public:
  /// @param zones  in force from the start, copied.
  /// @param map    the ground as believed; outlives the agent.
  /// @param pilot  who commands.
  ZoneDecorator(const ZoneAvoidanceOptions& options, EntityId self,
                const FlightLimits& limits, const Terrain& map,
                std::span<const Zone> zones, std::unique_ptr<Agent> pilot);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  void shield(const AgentInput& in, AgentOutput& out);

  ZoneMonitor zones_;
  ReturnPlanner returns_;
  std::unique_ptr<Agent> pilot_;
  std::optional<AutopilotCommand> setpoint_;  // the pilot's last
  bool held_ = false;                         // it was not to take off
  std::optional<Vec2> home_;
};

}  // namespace skein::reasoning
