// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/observation_memory.h"

namespace skein::mixed {

ObservationFate ObservationMemory::add(const Observation& observation, Time now) {
  if (observation.source != Reality::kPhysical) return ObservationFate::kRefused;
  const auto forgotten = forgotten_.find(observation.object);
  if (forgotten != forgotten_.end() && observation.time <= forgotten->second)
    return ObservationFate::kLate;
  const auto [at, first] =
      entries_.try_emplace(observation.object, Entry{observation, now});
  if (first) return ObservationFate::kRemembered;
  if (observation.time < at->second.observation.time) return ObservationFate::kLate;
  at->second = {observation, now};
  return ObservationFate::kRemembered;
}

bool ObservationMemory::look_in_vain(std::uint32_t object, Time time) {
  const auto found = entries_.find(object);
  if (found == entries_.end() || time <= found->second.observation.time) return false;
  const int needed = rules_.looks(found->second.observation.what);
  if (++found->second.looks_in_vain != needed) return false;
  if (rules_.model == ForgettingModel::kLogical) forget(object, time);
  return true;
}

std::vector<Observation> ObservationMemory::expire(Time now) {
  std::vector<Observation> expired;
  if (rules_.model != ForgettingModel::kTemporal) return expired;
  for (const auto& [object, entry] : entries_) {
    const auto max_age = rules_.max_age_of(entry.observation.what);
    if (max_age && now - entry.observation.time > *max_age)
      expired.push_back(entry.observation);
  }
  for (const Observation& each : expired) forget(each.object, each.time);
  return expired;
}

const ObservationMemory::Entry* ObservationMemory::find(std::uint32_t object) const {
  const auto found = entries_.find(object);
  return found == entries_.end() ? nullptr : &found->second;
}

void ObservationMemory::forget(std::uint32_t object, Time time) {
  entries_.erase(object);
  forgotten_[object] = time;
}

}  // namespace skein::mixed
