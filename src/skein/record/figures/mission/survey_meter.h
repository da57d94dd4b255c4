// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/data/team/mission.h"
#include "skein/record/figures/mission/mission_meter.h"

namespace skein::record {

/// The share of an area that has been seen: of the cells of a raster, a sixteenth of the
/// swath wide, those with their middle in the area that an aircraft has passed within
/// half a swath. Figures: `seen` (0 to 1), `seen_95_s` and `seen_all_s` (when that share
/// was reached), `planned_s` (duration of the mission's first plan) and
/// `seen_all_of_plan` (times that duration, from when the plan was made).
class SurveyMeter final : public MissionMeter {
 public:
  /// @param begin  of the mission.
  SurveyMeter(const SurveyGoal& goal, Time begin);

  void goal_changed(const MissionGoal& goal) override;
  void moved(Time time, EntityId aircraft, const Vec2& from, const Vec2& to) override;
  std::vector<MissionFigure> figures(Time now) const override;

  double seen() const;

 private:
  enum class Cell : std::uint8_t { kOutside, kUnseen, kSeen };
  void see_around(const Vec2& place);

  Time begin_;
  double planned_at_, planned_for_;  // [s]
  Vec2 low_;
  double cell_, reach_;
  int rows_ = 0, columns_ = 0;
  std::vector<Cell> cells_;
  std::int64_t inside_ = 0, seen_ = 0;
  std::optional<Time> seen_95_, seen_all_;
};

}  // namespace skein::record
