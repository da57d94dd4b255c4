// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <vector>

#include "skein/data/vehicle/agent_step.h"
#include "skein/layer/reasoning/belief/team_memory.h"
#include "skein/layer/reasoning/belief/traffic/traffic_tracker.h"

namespace skein::reasoning {

/// What is believed on board of aircraft that do not belong to the team: tracks of what
/// the own sensors for traffic say (TrafficTracker), placed by where the autopilot
/// believed to be when they measured. Who reports to the team is no intruder.
class TrafficBeliefs {
 public:
  /// Takes in what was sensed, forgets what is too old, and records each track once a
  /// second. Needs in.nav.
  void step(const AgentInput& in, const TeamMemory& team, AgentOutput& out);

  /// All of them; those that may be acted on are firm (is_firm()).
  const TrafficTracker& tracker() const { return tracker_; }

 private:
  NavEstimate own_at(Time time) const;
  TrafficMeasurement measured(const TrafficBroadcast& heard) const;
  TrafficMeasurement measured(const RadarPlot& plot) const;
  TrafficMeasurement measured(const TransponderContact& contact) const;
  void record(Time now, AgentOutput& out);

  bool listens_ = false;         // something has been sensed
  std::deque<NavEstimate> own_;  // of the last seconds, in order of time; else the last
  std::vector<TrafficMeasurement> measurements_;  // of one step
  std::vector<TeamPlace> team_;                   // the same
  TrafficTracker tracker_;
  Time next_record_;
};

/// A track as it is at a time, for records.
TrafficBelief belief_at(Time now, const TrafficTrack& track);

}  // namespace skein::reasoning
