// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/mission/tasking_mission.h"

namespace skein::reasoning {

/// Patrols a line with the aircraft it is given, evenly spaced along a round: one after
/// the other is sent off when the one before is far enough, and they are sent off anew
/// when one comes or goes.
class PatrolMission final : public TaskingMission {
 public:
  PatrolMission(const std::vector<EntityId>& team, const Patrol& patrol)
      : TaskingMission(team), patrol_(patrol) {}

  MissionDemand demand() const override;
  MissionGoal goal() const override;
  bool done() const override { return done_; }

 private:
  void pursue(const AgentInput& in, AgentOutput& out) override;
  double round_time(const Aircraft& aircraft) const;

  Patrol patrol_;
  int flown_by_ = 0;  // aircraft, at the last look
  Time next_;         // the next one is sent off
  std::vector<EntityId> sent_;
  bool done_ = false;
};

}  // namespace skein::reasoning
