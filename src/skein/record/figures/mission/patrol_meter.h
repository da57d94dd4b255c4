// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/data/team/mission.h"
#include "skein/record/figures/mission/mission_meter.h"

namespace skein::record {

/// How often a line is visited: by points 25 m apart, at each of which a visit begins
/// when an aircraft comes within reach after nobody was for 10 s. Figures: `visited`
/// (share of the points), `revisit_mean_s` and `revisit_max_s` (from the end of one visit
/// to the begin of the next), `age_max_s` (since the oldest last visit).
class PatrolMeter final : public MissionMeter {
 public:
  PatrolMeter(const PatrolGoal& goal, Time begin);

  void moved(Time time, EntityId aircraft, const Vec2& from, const Vec2& to) override;
  std::vector<MissionFigure> figures(Time now) const override;

 private:
  struct Point {
    Vec2 place;
    std::optional<Time> visited;  // last
  };
  double reach_;
  Time begin_;
  std::vector<Point> points_;
  double gaps_ = 0, longest_ = 0;  // between visits [s]
  int count_ = 0;                  // of gaps
};

}  // namespace skein::record
