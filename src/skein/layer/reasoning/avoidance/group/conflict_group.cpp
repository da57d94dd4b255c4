// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/group/conflict_group.h"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include "skein/layer/reasoning/avoidance/encounter/flight_envelope.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {

const std::optional<PlanEncounter>& ConflictGroups::encounter(const TeamFlight& a,
                                                              const TeamFlight& b,
                                                              double now) {
  if (b.who < a.who) return encounter(b, a, now);
  const auto [at, first] = looked_.try_emplace(Pair{a.who, b.who});
  Looked& looked = at->second;
  if (first || looked.a != a.number || looked.b != b.number ||
      (looked.encounter && looked.encounter->end <= now))
    looked = {a.number, b.number,
              first_encounter(a.plan, b.plan, separation_between(a, b), now,
                              std::numeric_limits<double>::infinity())};
  return looked.encounter;
}

ConflictGroup ConflictGroups::find(Time now, std::span<const Conflict> conflicts,
                                   std::span<const TeamFlight> others, double until,
                                   std::size_t most) {
  std::erase_if(looked_, [&](const auto& each) {
    return !std::ranges::binary_search(others, each.first.first, {}, &TeamFlight::who) ||
           !std::ranges::binary_search(others, each.first.second, {}, &TeamFlight::who);
  });
  // Conflicts of members with those who are none yet: when, with whom, until when.
  std::set<std::tuple<double, EntityId, double>> border;
  for (const Conflict& each : conflicts)
    if (each.encounter.begin < until)
      border.emplace(each.encounter.begin, each.other, each.encounter.end);
  ConflictGroup group;
  while (!border.empty() && group.others.size() + 1 < most) {
    const auto [begin, who, end] = *border.begin();
    border.erase(border.begin());
    group.apart = std::max(group.apart, end);
    if (std::ranges::find(group.others, who) != group.others.end()) continue;
    const auto member = std::ranges::lower_bound(others, who, {}, &TeamFlight::who);
    if (member == others.end() || member->who != who) continue;
    group.others.push_back(who);
    if (member->plan.empty() || model::end_time_of(member->plan) <= now.seconds())
      continue;
    FlightEnvelope room(now.seconds(), model::end_time_of(member->plan));
    room.add(member->plan);
    for (const TeamFlight& each : others) {
      if (each.who == who || !each.conforms(now) ||
          !room.may_meet(each.plan, separation_between(*member, each)))
        continue;
      if (const auto& met = encounter(*member, each, now.seconds());
          met && met->begin < until)
        border.emplace(met->begin, each.who, met->end);
    }
  }
  std::ranges::sort(group.others);
  return group;
}

}  // namespace skein::reasoning
