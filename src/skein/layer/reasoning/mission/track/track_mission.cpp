// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/mission/track/track_mission.h"

#include <fmt/format.h>

#include <algorithm>

namespace skein::reasoning {

MissionDemand TrackMission::demand() const {
  MissionDemand demand;
  demand.min = demand.max = static_cast<int>(targets_.size());
  // Near one that nobody tracks yet.
  for (const auto& [object, target] : targets_)
    if (!target.tracker)
      if (const auto belief = memory_.find(object)) demand.place = belief->position;
  return demand;
}

bool TrackMission::wanted(std::uint32_t object) const {
  return options_.objects.empty() ||
         std::count(options_.objects.begin(), options_.objects.end(), object) > 0;
}

void TrackMission::pursue(const AgentInput& in, AgentOutput& out) {
  listen_for_objects(in, out);
  memory_.forget(in.now);
  for (auto it = targets_.begin(); it != targets_.end();) {
    const bool lost = (in.now - it->second.seen).seconds() > options_.lost_after;
    if (lost)
      out.events.push_back({in.now,
                            EntityId{},
                            EventKind::kObjectLost,
                            fmt::format("object {} has not been seen for {:.0f} s",
                                        it->first, options_.lost_after),
                            {.value = it->first}});
    it = lost ? targets_.erase(it) : std::next(it);
  }
  for (auto& [object, target] : targets_) {
    const auto tracker =
        std::find_if(team().begin(), team().end(),
                     [&](const Aircraft& a) { return target.tracker == a.id; });
    if (tracker == team().end() || !tracker->mine) target.tracker.reset();
  }
  assign(in.now, out);
  record_beliefs(in.now, out);
}

void TrackMission::record_beliefs(Time now, AgentOutput& out) {
  if (now < next_record_) return;
  next_record_ = now + options_.record_period;
  for (const auto& [object, target] : targets_)
    if (const auto belief = memory_.find(object)) out.records.emplace_back(*belief);
}

void TrackMission::listen_for_objects(const AgentInput& in, AgentOutput& out) {
  for (const Message& message : in.inbox) {
    const auto* sighting = std::get_if<ObjectSighting>(&message.content);
    if (!sighting || !wanted(sighting->object)) continue;
    memory_.add(*sighting);
    const auto [at, first] = targets_.try_emplace(sighting->object, Target{});
    at->second.seen = std::max(at->second.seen, sighting->time);
    if (first)
      out.events.push_back(
          {in.now,
           message.from,
           EventKind::kObjectFound,
           fmt::format("object {} at {:.0f} m north, {:.0f} m east", sighting->object,
                       sighting->position.x(), sighting->position.y()),
           {.value = sighting->object}});
    if (at->second.tracker && *at->second.tracker != message.from) {
      Message passed_on;
      passed_on.to = *at->second.tracker;
      passed_on.content = *sighting;
      out.outbox.push_back(std::move(passed_on));
    }
  }
}

// The nearest aircraft without an object for each object without an aircraft.
void TrackMission::assign(Time now, AgentOutput& out) {
  for (auto& [object, target] : targets_) {
    const auto belief = memory_.find(object);
    if (target.tracker || !belief) continue;
    const Vec2 place = belief->at(now);
    Aircraft* nearest = nullptr;
    for (Aircraft& each : team()) {
      const bool tracks =
          std::any_of(targets_.begin(), targets_.end(),
                      [&](const auto& t) { return t.second.tracker == each.id; });
      if (!each.mine || tracks) continue;
      const auto distance = [&](const Aircraft& a) {
        return (geo::horizontal(a.nav.p_N) - place).norm();
      };
      if (!nearest || distance(each) < distance(*nearest)) nearest = &each;
    }
    if (!nearest) continue;
    target.tracker = nearest->id;
    Orbit orbit;
    orbit.point = place;
    orbit.object = object;
    orbit.radius = options_.radius;
    orbit.weave = options_.weave;
    order(*nearest, orbit, now, out);
    // What is known of it comes first.
    Message known;
    known.to = nearest->id;
    known.content =
        ObjectSighting{object, belief->time, belief->position, belief->position_sd};
    out.outbox.push_back(std::move(known));
  }
}

}  // namespace skein::reasoning
