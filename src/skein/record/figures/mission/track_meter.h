// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "skein/data/team/mission.h"
#include "skein/record/figures/mission/mission_meter.h"
#include "skein/record/figures/object_track.h"

namespace skein::record {

/// How well objects are kept in view, from when each was first found. One is in view when
/// it was in one of the pictures of the last two seconds, by its true place and the
/// picture's ground. Figures: `found` (objects), `in_view` (share of that time, mean of
/// the objects), `in_view_worst` (of the object with the least), `error_rms_m` and
/// `error_max_m` (of the mission's belief against the truth, horizontal).
class TrackMeter final : public MissionMeter {
 public:
  explicit TrackMeter(TrackGoal goal) : goal_(std::move(goal)) {}

  void detected(const Detection& detection) override;
  void pictured(const Footprint& picture) override;
  void object_moves(const ObjectMotion& motion) override;
  void believed(Time time, const ObjectBelief& belief) override;
  void tick(Time now) override;
  std::vector<MissionFigure> figures(Time now) const override;

 private:
  struct Target {
    ObjectTrack track;
    bool found = false;
    std::optional<Time> pictured;  // last
    int seconds = 0, in_view = 0;  // since it was found
  };
  bool counts(std::uint32_t object) const;

  TrackGoal goal_;
  std::map<std::uint32_t, Target> targets_;
  double squared_errors_ = 0, largest_error_ = 0;
  int errors_ = 0;
};

}  // namespace skein::record
