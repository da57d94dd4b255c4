// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/data/team/task.h"
#include "skein/layer/reasoning/mission/tasking_mission.h"

namespace skein::reasoning {

/// From `at` on, the team's aircraft `leader` leads.
struct Leadership {
  Time at;
  std::size_t leader = 0;  ///< index in the team
};

struct FormationOptions {
  std::vector<EntityId> team;
  std::vector<Vec2> route;  ///< flown by the leader [m]
  int laps = 1000;
  /// Slots ahead of the leader and to its right [m]; the followers take them in the order
  /// of the team.
  std::vector<Vec2> slots;
  std::vector<Leadership> leaders;  ///< in order of time; the first at 0
  /// The leader reports its position to its followers; else the station passes it on.
  bool direct = false;
  /// A leader that is not counted on (unheard for 5 s, or under another command) for so
  /// long while others are is replaced by the first of these [s]. It flies the route from
  /// its first corner on.
  double leader_timeout = 30;
};

/// A flight in formation: says who leads and who follows, and finds another leader when
/// the one there is drops out. The followers hear of the leader's position from itself or
/// from the station.
class FormationControl final : public TaskingMission {
 public:
  explicit FormationControl(const FormationOptions& options);

  MissionDemand demand() const override;
  MissionGoal goal() const override;
  std::uint32_t goal_number() const override { return goal_number_; }

 private:
  void pursue(const AgentInput& in, AgentOutput& out) override;
  bool is_gone(std::size_t k, Time now) const;
  void replace_lost_leader(Time now, AgentOutput& out);
  void appoint(std::size_t leader, Time now, AgentOutput& out);

  FormationOptions options_;
  std::optional<std::size_t> leader_;
  Time leads_;            // when the leader was last known to
  std::size_t next_ = 0;  // of options_.leaders
  std::uint32_t goal_number_ = 0;
};

}  // namespace skein::reasoning
