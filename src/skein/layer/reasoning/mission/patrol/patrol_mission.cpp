// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/mission/patrol/patrol_mission.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/solve/touring/patrol.h"

namespace skein::reasoning {

namespace {

// A point of the line counts as visited from so near, beyond the offset [m]: corners are
// cut by turns.
constexpr double kReach = 50;

}  // namespace

MissionGoal PatrolMission::goal() const {
  return PatrolGoal{patrol_.line, patrol_.closed, std::abs(patrol_.offset) + kReach};
}

MissionDemand PatrolMission::demand() const {
  MissionDemand demand;
  if (done_) demand.max = 0;
  demand.place = patrol_.line.front();
  return demand;
}

double PatrolMission::round_time(const Aircraft& aircraft) const {
  solve::PatrolQuery query;
  query.line = patrol_.line;
  query.closed = patrol_.closed;
  query.offset = patrol_.offset;
  query.altitude_msl = -aircraft.nav.p_N.z();
  query.starts = {{aircraft.nav.p_N, aircraft.nav.heading}};
  query.limits = *aircraft.limits;
  query.wind = aircraft.nav.wind_N;
  return solve::plan_patrol(query).round_time;
}

void PatrolMission::pursue(const AgentInput& in, AgentOutput& out) {
  const int count = mine();
  if (count == 0 || done_) return;
  if (count != std::exchange(flown_by_, count)) {
    sent_.clear();
    next_ = in.now;
  }
  bool all_done = true;
  for (Aircraft& each : team()) {
    if (!each.mine) continue;
    const bool sent = std::count(sent_.begin(), sent_.end(), each.id) > 0;
    if (sent && each.has_done()) continue;
    all_done = false;
    if (sent || in.now < next_) continue;
    sent_.push_back(each.id);
    order(each, patrol_, in.now, out);
    next_ = in.now + Time::from_seconds(round_time(each) / count);
  }
  done_ = all_done && patrol_.rounds > 0;
}

}  // namespace skein::reasoning
