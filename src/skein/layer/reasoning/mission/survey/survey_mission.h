// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "skein/data/airspace/zone_set.h"
#include "skein/layer/reasoning/mission/tasking_mission.h"
#include "skein/role/path_planner.h"

namespace skein::reasoning {

struct SurveyMissionOptions {
  Survey survey;                       ///< what is to be seen; `lines` is not used
  std::optional<double> bearing = {};  ///< of the lines [rad]; none: the quickest
  std::vector<Zone> zones;             ///< no-fly zones in force from the start
  double zone_margin = 30;             ///< kept from them [m]
  std::shared_ptr<const PathPlanner> planner;  ///< around zones; null: none
  double settling = 10;  ///< waits for reports of all aircraft, and their wind [s]
};

/// Sees all of an area with the aircraft it is given.
///
/// Lines are planned for all of them, so that they are done as early as possible
/// (solve::plan_coverage), with the mean of the wind that they believe in. What an
/// aircraft leaves that is lost or taken away is shared among the others with what these
/// have left, and a share of it goes to one that comes later or has no line left, where
/// the survey ends earlier for it. Who is on a line flies it to its end first.
class SurveyMission final : public TaskingMission {
 public:
  SurveyMission(const std::vector<EntityId>& team, SurveyMissionOptions options);

  MissionDemand demand() const override;
  MissionGoal goal() const override;
  std::uint32_t goal_number() const override { return planned_ ? 1 : 0; }
  bool done() const override { return done_; }

 private:
  void pursue(const AgentInput& in, AgentOutput& out) override;
  void plan(Time now, AgentOutput& out);
  void share_anew(Time now, AgentOutput& out);
  /// The line that an aircraft is on, from where it is when an order reaches it.
  struct OwnLine {
    std::vector<Vec2> ends;  // two; empty: it is on none
    bool too_short = false;  // it is all but at its end: wait
  };
  OwnLine line_of(const Aircraft& aircraft) const;
  bool must_share(Time now) const;
  std::vector<Vec2> left_of(const Aircraft& aircraft) const;
  std::vector<Aircraft*> own();
  Vec2 wind() const;
  FlightLimits limits() const;
  void give(const std::vector<Aircraft*>& who,
            const std::vector<std::vector<Vec2>>& lines, Time now, AgentOutput& out);

  SurveyMissionOptions options_;
  ZoneSet zones_;
  std::optional<Time> begun_;  // there was an aircraft
  bool planned_ = false, done_ = false;
  Time planned_at_;              // the first plan
  double planned_for_ = 0;       // its duration [s]
  std::vector<bool> has_lines_;  // of the team: it has been given some
  std::vector<Vec2> nobodys_;    // lines of those that were lost
  Time shared_;
  std::string why_not_;  // it could not be planned; said once
};

}  // namespace skein::reasoning
