// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "skein/base/id.h"
#include "skein/layer/reasoning/agent/commanded/mission_flight.h"
#include "skein/role/agent.h"
#include "skein/role/terrain.h"

namespace skein::reasoning {

struct CommandedAgentOptions {
  double take_off_height = 50;  ///< of a take-off without an altitude [m]
  double patience = 3;          ///< setpoints that end: it then holds its place [s]
};

/// The agent of an aircraft that thinks for itself no further than an autopilot does: it
/// flies what programs outside ask for (VehicleCommand), from moment to moment, to
/// places, or its stored mission.
class CommandedAgent final : public Agent {
 public:
  CommandedAgent(const CommandedAgentOptions& options, EntityId self,
                 const FlightLimits& limits, std::shared_ptr<const Terrain> map);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  struct Obedience;

  void obey(const VehicleRequest& request, const AgentInput& in, AgentOutput& out);
  void give(decltype(AutopilotCommand::guidance) guidance, double altitude_msl,
            AgentOutput& out);
  void hold(const AgentInput& in, AgentOutput& out);
  void land(const LandRequest& request, const AgentInput& in, AgentOutput& out);
  void follow(const TrackSetpoint& setpoint, const AgentInput& in, AgentOutput& out);
  bool hovers() const { return limits_.slowest <= 0; }

  CommandedAgentOptions options_;
  EntityId self_;
  FlightLimits limits_;
  std::shared_ptr<const Terrain> map_;
  MissionFlight mission_;
  MissionProgress reported_;
  std::optional<double> airspeed_;  // commanded
  std::optional<Time> setpoint_;    // last, while flown by them
  std::optional<AutopilotCommand> last_;
  std::optional<Vec3> home_;
};

}  // namespace skein::reasoning
