// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/server_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "skein/base/math.h"
#include "skein/geo/polygon.h"

namespace skein::mixed {
namespace {

// Distance from a point to the nearest edge of a closed line [m].
double distance_to_edge(std::span<const Vec2> ring, const Vec2& p) {
  double nearest = math::kInfinity;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 edge = ring[(k + 1) % ring.size()] - ring[k], to_p = p - ring[k];
    const double square = edge.squaredNorm();
    const double share = square > 0 ? std::clamp(to_p.dot(edge) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (to_p - share * edge).norm());
  }
  return nearest;
}

bool shows(const Footprint& picture, const Observation& remembered) {
  return geo::contains(picture.corners, remembered.position) &&
         distance_to_edge(picture.corners, remembered.position) >=
             2 * remembered.position_sd;
}

}  // namespace

ServerMemory::ServerMemory(const ServerMemoryOptions& options,
                           const std::vector<KnownObject>& objects,
                           std::vector<KnownEntity> entities,
                           std::shared_ptr<const Terrain> terrain)
    : options_(options),
      entities_(std::move(entities)),
      terrain_(std::move(terrain)),
      memory_(options.forgetting) {
  for (const KnownObject& each : objects)
    objects_[each.object.id] = {
        each,
        options.forgetting.rate_of(each.object.what) == RateOfChange::kStable,
        Time(),
        {}};
}

void ServerMemory::begin_step(Time now) {
  const std::vector<Observation> expired = memory_.expire(now);
  for (const Observation& each : expired)
    forget(now, each, ObservationFate::kExpired, objects_.at(each.object));
  if (!expired.empty()) refresh();
}

void ServerMemory::take_position(Time now, EntityId aircraft, const Vec3& p_N) {
  if (entities_.at(aircraft.value).reality.presence == Reality::kPhysical) return;
  if (any_stable_unknown()) passages_.add(now, aircraft, p_N);
}

void ServerMemory::take_payload(Time now, EntityId aircraft,
                                std::span<const Footprint> pictures,
                                std::span<const Detection> detections) {
  for (const Detection& each : detections)
    if (const auto known = objects_.find(each.object); known != objects_.end())
      see(now, each, known->second);
  if (includes_physical(entities_.at(aircraft.value).reality.updates))
    for (const Footprint& each : pictures) look(now, aircraft, each);
  refresh();
}

void ServerMemory::see(Time now, const Detection& detection, Known& known) {
  const Reality updates = entities_.at(detection.aircraft.value).reality.updates;
  const Observation seen{
      detection.object,
      detection.time,
      detection.point,
      detection.point_sd,
      known.what.object.what,
      detection.aircraft,
      includes_physical(updates) ? Reality::kPhysical : Reality::kVirtual};
  std::optional<Observation> before;
  if (const auto* entry = memory_.find(seen.object)) before = entry->observation;
  const ObservationFate fate = memory_.add(seen, now);
  observations_.push_back({now, seen, fate});
  if (fate == ObservationFate::kRefused) return refuse(now, seen, known);
  if (fate != ObservationFate::kRemembered) return;
  if (before)
    compare(now, *before, seen, known);
  else if (known.stable)
    find_passages(now, seen, known);
  known.relied.clear();
}

// A virtual sensor has seen what is remembered: that makes it no younger, but whoever saw
// it relies on it now.
void ServerMemory::refuse(Time now, const Observation& seen, Known& known) {
  const auto* entry = memory_.find(seen.object);
  if (entry && seen.time > entry->since)
    known.relied.try_emplace(seen.observer, seen.time);
  if (!refused_.emplace(seen.observer, seen.object).second) return;
  events_.push_back({now, seen.observer, EventKind::kUpdateRefused,
                     fmt::format("{}: seen in the server's memory only; that does not "
                                 "refresh it",
                                 known.what.object.name)});
}

void ServerMemory::compare(Time now, const Observation& before, const Observation& seen,
                           Known& known) {
  const double distance = (seen.position - before.position).norm();
  const double sd = math::hypot(before.position_sd, seen.position_sd);
  if (distance <= options_.moved + 3 * sd) return;
  report_reliance(now, seen.observer, fmt::format("is {:.0f} m from there", distance),
                  before, known);
}

void ServerMemory::find_passages(Time now, const Observation& seen, const Known& known) {
  const double ground = terrain_->elevation_msl(seen.position);
  const PhysicalObject& body = known.what.body;
  const Cylinder cylinder{seen.position, body.radius, ground, ground + body.height};
  for (const Passage& each : passages_.nearest(cylinder, known.unknown_since, seen.time,
                                               options_.safety_radius))
    events_.push_back(
        {now,
         each.aircraft,
         EventKind::kUnknownObjectInteraction,
         fmt::format("{} {} at {:.1f} s, {:.1f} m from it (its place is known to {:.1f} "
                     "m); nobody knew of it until {} saw it at {:.1f} s",
                     each.distance > 0 ? "passed" : "went through",
                     known.what.object.name, each.time.seconds(), each.distance,
                     seen.position_sd, name_of(seen.observer), seen.time.seconds()),
         {.value = each.distance}});
}

// What was found in the picture is remembered as of its time by now: the look was not in
// vain.
void ServerMemory::look(Time now, EntityId aircraft, const Footprint& picture) {
  for (auto& [id, known] : objects_) {
    const auto* entry = memory_.find(id);
    if (entry && shows(picture, entry->observation))
      miss(now, aircraft, picture.time, known);
  }
}

void ServerMemory::miss(Time now, EntityId aircraft, Time picture, Known& known) {
  const std::uint32_t id = known.what.object.id;
  const Observation last = memory_.find(id)->observation;
  if (!memory_.look_in_vain(id, picture)) return;
  report_reliance(now, aircraft, "is not found there", last, known);
  if (!memory_.find(id)) forget(now, last, ObservationFate::kNotFound, known);
}

void ServerMemory::forget(Time now, const Observation& last, ObservationFate fate,
                          Known& known) {
  known.unknown_since = now;
  known.relied.clear();
  observations_.push_back({now, last, fate});
  events_.push_back(
      {now, last.observer, EventKind::kForgotten,
       fmt::format(
           "{}: last seen at {:.1f} s, {}", known.what.object.name, last.time.seconds(),
           fate == ObservationFate::kExpired ? "too long ago" : "not found there")});
}

void ServerMemory::report_reliance(Time now, EntityId finder, const std::string& found,
                                   const Observation& remembered, Known& known) {
  if (known.relied.empty()) return;
  std::string who;
  for (const auto& [entity, since] : known.relied)
    who += fmt::format("{}{} from {:.1f} s on", who.empty() ? "" : ", ", name_of(entity),
                       since.seconds());
  events_.push_back(
      {now, finder, EventKind::kNonActualObservation,
       fmt::format("{}: remembered at {:.0f} m north, {:.0f} m east as of {:.1f} s, {}; "
                   "relied on by {}",
                   known.what.object.name, remembered.position.x(),
                   remembered.position.y(), remembered.time.seconds(), found, who)});
  known.relied.clear();
}

const std::string& ServerMemory::name_of(EntityId entity) const {
  return entities_.at(entity.value).name;
}

bool ServerMemory::any_stable_unknown() const {
  return std::any_of(objects_.begin(), objects_.end(), [&](const auto& each) {
    return each.second.stable && !memory_.find(each.first);
  });
}

void ServerMemory::refresh() {
  visible_.clear();
  for (const auto& [id, entry] : memory_.entries())
    visible_.push_back({id, entry.observation.what, entry.observation.position});
}

void ServerMemory::take_news(std::vector<ObservationRecord>& observations,
                             std::vector<Event>& events) {
  for (ObservationRecord& each : observations_) observations.push_back(std::move(each));
  for (Event& each : events_) events.push_back(std::move(each));
  observations_.clear();
  events_.clear();
}

}  // namespace skein::mixed
