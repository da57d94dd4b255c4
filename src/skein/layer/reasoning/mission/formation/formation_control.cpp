// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/mission/formation/formation_control.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"

namespace skein::reasoning {

FormationControl::FormationControl(const FormationOptions& options)
    : TaskingMission(options.team), options_(options) {
  SKEIN_CHECK(options.slots.size() + 1 >= options.team.size());
  for (const Leadership& change : options.leaders)
    SKEIN_CHECK(change.leader < options.team.size());
}

void FormationControl::pursue(const AgentInput& in, AgentOutput& out) {
  const auto& changes = options_.leaders;
  for (; next_ < changes.size() && changes[next_].at <= in.now; ++next_) {
    const std::size_t leader = changes[next_].leader;
    // Whoever is known to be gone does not take over.
    if (leader_ && (*leader_ == leader || is_gone(leader, in.now))) continue;
    appoint(leader, in.now, out);
  }
  replace_lost_leader(in.now, out);
}

bool FormationControl::is_gone(std::size_t k, Time now) const {
  const Aircraft& each = team()[k];
  return mine() > 0 && !each.mine &&
         (now - each.heard).seconds() > options_.leader_timeout;
}

void FormationControl::replace_lost_leader(Time now, AgentOutput& out) {
  if (!leader_) return;
  // While nobody is heard, or the mission is paused, that says nothing of the leader.
  if (team()[*leader_].mine || mine() == 0) leads_ = now;
  if ((now - leads_).seconds() <= options_.leader_timeout) return;
  const auto first = std::find_if(team().begin(), team().end(),
                                  [](const Aircraft& each) { return each.mine; });
  if (first == team().end()) return;  // nobody else is there either
  out.events.push_back({now, team()[*leader_].id, EventKind::kLeaderLost,
                        "has been silent, or under another command, for too long"});
  appoint(static_cast<std::size_t>(first - team().begin()), now, out);
}

MissionDemand FormationControl::demand() const {
  MissionDemand demand;
  demand.max = static_cast<int>(options_.team.size());
  demand.place = options_.route.front();
  return demand;
}

MissionGoal FormationControl::goal() const {
  const std::size_t leader = leader_.value_or(options_.leaders.front().leader);
  FormationGoal goal{options_.team[leader], {}, {}};
  for (std::size_t k = 0; k < options_.team.size(); ++k) {
    if (k == leader) continue;
    goal.slots.push_back(options_.slots[goal.followers.size()]);
    goal.followers.push_back(options_.team[k]);
  }
  return goal;
}

void FormationControl::appoint(std::size_t leader, Time now, AgentOutput& out) {
  if (leader_) ++goal_number_;
  leader_ = leader;
  leads_ = now;
  const EntityId leads = options_.team[leader];
  std::size_t slot = 0;
  for (std::size_t k = 0; k < team().size(); ++k) {
    if (k != leader) {
      order(team()[k], FollowLeader{leads, options_.slots[slot++]}, now, out);
      continue;
    }
    FlyRoute route{options_.route, options_.laps, {}};
    for (const EntityId id : options_.team)
      if (options_.direct && id != leads) route.report_to.push_back(id);
    order(team()[k], std::move(route), now, out);
  }
  out.events.push_back({now, leads, EventKind::kLeader, "leads the formation"});
}

}  // namespace skein::reasoning
