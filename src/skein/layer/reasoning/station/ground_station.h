// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "skein/layer/reasoning/station/heartbeat.h"
#include "skein/layer/reasoning/station/mission_control.h"
#include "skein/layer/reasoning/station/zone_server.h"
#include "skein/layer/reasoning/team/onboard/team_server.h"

namespace skein::reasoning {

struct GroundStationOptions {
  EntityId id = {};                 ///< of itself
  std::vector<NamedAircraft> team;  ///< its aircraft
  NavEstimate position;             ///< of itself
  Time heartbeat;                   ///< between two heartbeats; 0: none
  ZoneServerOptions zones;
  std::string name = {};                  ///< of itself
  std::shared_ptr<TeamServer> desk = {};  ///< of its team that leads itself; none: null
};

/// The agent of a ground station: says which no-fly zones are in force, pursues its
/// missions, obeys the operator, and sends heartbeats.
class GroundStation final : public Agent {
 public:
  GroundStation(const GroundStationOptions& options, std::vector<PlannedMission> missions,
                std::unique_ptr<const Allocator> allocator);

  void step(const AgentInput& in, AgentOutput& out) override;

 private:
  void obey(const AllocationCommand& command, Time now, AgentOutput& out);
  void obey(const TeamTaskCommand& command, Time now, AgentOutput& out);
  void refuse(std::string_view what, const std::string& why, Time now,
              AgentOutput& out) const;

  ZoneServer zones_;
  OrderServer orders_;
  MissionControl missions_;
  HeartbeatSender heartbeat_;
  std::string name_;
  std::shared_ptr<TeamServer> desk_;
};

}  // namespace skein::reasoning
