// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "skein/data/team/mission.h"
#include "skein/record/figures/mission/mission_meter.h"

namespace skein::record {

/// How well followers keep their places. Once a second the true distance of each from its
/// place, which turns with the leader's course over ground; counted from when the
/// follower first was within 30 m of it, changes of leaders included. Figures:
/// `slot_error_mean_m`, `slot_error_95_m` (which 95 % of these distances keep below),
/// `slot_error_max_m`, `in_place` (share of that time within 30 m, mean of the followers;
/// without a leader nobody is in place), `apart_min_m` (least distance between any two
/// that have been at their places).
class FormationMeter final : public MissionMeter {
 public:
  explicit FormationMeter(FormationGoal goal) : goal_(std::move(goal)) {}

  void goal_changed(const MissionGoal& goal) override;
  void moved(Time time, EntityId id, const Vec2& from, const Vec2& to) override;
  void left(EntityId id) override;
  void tick(Time now) override;
  std::vector<MissionFigure> figures(Time now) const override;

 private:
  struct Flight {
    Vec2 place = Vec2::Zero();
    Vec2 course = Vec2::Zero();  // unit; 0: it has not moved yet
    bool there = true;           // it takes part
    bool arrived = false;        // it has been at its place, or leads
    int seconds = 0, in_place = 0;
  };

  FormationGoal goal_;
  std::map<EntityId, Flight> flights_;
  std::vector<float> errors_;  // [m]
  std::optional<double> apart_;
};

}  // namespace skein::record
