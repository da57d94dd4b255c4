// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "skein/layer/reasoning/belief/object_memory.h"
#include "skein/layer/reasoning/mission/tasking_mission.h"

namespace skein::reasoning {

struct TrackMissionOptions {
  /// Objects to be tracked; empty: every one that anybody sees.
  std::vector<std::uint32_t> objects;
  double radius = 0;        ///< of the circles [m]; 0: as small as the aircraft can
  bool weave = false;       ///< S-turns instead
  double lost_after = 120;  ///< an object unseen for so long is given up [s]
  /// Between two records of what is believed of the objects.
  Time record_period = Time::from_seconds(5);
};

/// Keeps an aircraft with each object that has been seen, as far as it is given some; it
/// asks for as many as there are objects. Those that others see are passed on to the
/// aircraft that tracks them.
class TrackMission final : public TaskingMission {
 public:
  TrackMission(const std::vector<EntityId>& team, TrackMissionOptions options)
      : TaskingMission(team), options_(std::move(options)) {}

  MissionDemand demand() const override;
  MissionGoal goal() const override { return TrackGoal{options_.objects}; }

 private:
  void pursue(const AgentInput& in, AgentOutput& out) override;
  bool wanted(std::uint32_t object) const;
  void listen_for_objects(const AgentInput& in, AgentOutput& out);
  void assign(Time now, AgentOutput& out);
  void record_beliefs(Time now, AgentOutput& out);

  TrackMissionOptions options_;
  ObjectMemory memory_;
  struct Target {
    Time seen;
    std::optional<EntityId> tracker;
  };
  std::map<std::uint32_t, Target> targets_;
  Time next_record_;
};

}  // namespace skein::reasoning
