// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/run_view.h"

#include <variant>

namespace skein::simulation {
namespace {

template <class Beliefs>
auto beliefs_of(EntityId believer, const Beliefs& all) {
  std::vector<typename Beliefs::mapped_type> found;
  for (auto at = all.lower_bound({believer, std::string(), 0});
       at != all.end() && std::get<EntityId>(at->first) == believer; ++at)
    found.push_back(at->second);
  return found;
}

}  // namespace

void RunView::record(const Record& record) {
  if (const auto* event = std::get_if<Event>(&record)) {
    events_.push_back(*event);
  } else if (const auto* seen = std::get_if<PerimeterRecord>(&record)) {
    perimeters_[{seen->believer, seen->mission, seen->phenomenon}] = *seen;
  } else if (const auto* object = std::get_if<ObjectBeliefRecord>(&record)) {
    objects_[{object->id, object->value.mission, object->value.object}] = *object;
  } else if (const auto* track = std::get_if<TrafficBeliefRecord>(&record)) {
    auto& tracks = traffic_[track->id];
    if (!tracks.empty() && tracks.front().time < track->time) tracks.clear();
    tracks.push_back(*track);
  }
  next_.record(record);
}

std::vector<PerimeterRecord> RunView::perimeters(EntityId station) const {
  return beliefs_of(station, perimeters_);
}

std::vector<ObjectBeliefRecord> RunView::objects(EntityId station) const {
  return beliefs_of(station, objects_);
}

std::vector<TrafficBeliefRecord> RunView::traffic(EntityId aircraft) const {
  const auto found = traffic_.find(aircraft);
  return found == traffic_.end() ? std::vector<TrafficBeliefRecord>() : found->second;
}

}  // namespace skein::simulation
