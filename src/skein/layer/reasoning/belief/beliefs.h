// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "skein/layer/reasoning/belief/object_memory.h"
#include "skein/layer/reasoning/belief/team_memory.h"
#include "skein/layer/reasoning/belief/traffic_beliefs.h"

namespace skein::reasoning {

/// What an agent holds true of the world, besides what its autopilot says of itself and
/// the no-fly zones (ZoneMonitor): from its own sensors and from what others say.
class Beliefs {
 public:
  explicit Beliefs(EntityId station) : station_(station) {}

  /// Takes in what was received and sensed, forgets what is too old, and tells the ground
  /// station of objects that the own camera has seen, each once a second. Tracks of other
  /// traffic are recorded.
  void step(const AgentInput& in, AgentOutput& out);

  const ObjectMemory& objects() const { return objects_; }
  const TeamMemory& team() const { return team_; }
  /// Aircraft around that do not belong to the team.
  const TrafficTracker& traffic() const { return traffic_.tracker(); }

 private:
  void see(const DetectionSample& seen, const NavEstimate& nav, AgentOutput& out);

  EntityId station_;
  ObjectMemory objects_;
  TeamMemory team_;
  TrafficBeliefs traffic_;
  std::map<std::uint32_t, Time> reported_;  // when each object was reported last
};

}  // namespace skein::reasoning
