// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/server_memory.h"

#include <algorithm>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/remote_kind.h"
#include "skein/mixed/server_memory.h"

namespace skein::assemble {

EntityReality reality_of(const scenario::AircraftGroup& group) {
  const bool simulated = plant_is_simulated(group.vehicle);
  // One in another program may be simulated there: it is not taken for real unasked.
  const bool elsewhere = group.vehicle.kind == kRemoteKind;
  const bool physical = group.physical.value_or(!simulated && !elsewhere);
  const Reality own = physical && simulated ? Reality::kPhysical : Reality::kVirtual;
  return entity_reality(physical ? Reality::kPhysical : Reality::kVirtual,
                        group.observes.value_or(own));
}

PhysicalObject body_of(const scenario::PlacedObject& object, std::uint32_t id) {
  const PhysicalObject typical = typical_body(object.what);
  return {id, object.radius.value_or(typical.radius),
          object.height.value_or(typical.height)};
}

std::unique_ptr<WorldMemory> server_memory(const scenario::ServerMemory& described,
                                           const simulation::World& world,
                                           std::shared_ptr<const Terrain> map) {
  std::vector<mixed::KnownObject> objects;
  for (const simulation::WorldObject& each : world.objects)
    if (each.body) objects.push_back({each.object, *each.body});
  if (objects.empty()) return nullptr;
  std::vector<mixed::KnownEntity> entities;
  for (const simulation::Entity& each : world.entities)
    entities.push_back({each.name, each.reality});
  const mixed::ServerMemoryOptions options{described.forgetting, described.moved,
                                           described.safety_radius};
  return std::make_unique<mixed::ServerMemory>(options, objects, std::move(entities),
                                               std::move(map));
}

std::vector<std::string> memory_warnings(const scenario::Scenario& scenario) {
  const auto& objects = scenario.environment.objects;
  const auto& groups = scenario.aircraft;
  const bool physical = std::any_of(objects.begin(), objects.end(),
                                    [](const auto& each) { return each.physical; });
  const bool seen = std::any_of(groups.begin(), groups.end(), [](const auto& each) {
    return each.count > 0 && includes_physical(reality_of(each).updates);
  });
  if (!physical || seen) return {};
  return {
      "no aircraft has physical sensors: nobody will know of the physical objects. "
      "Give a group physical: true."};
}

}  // namespace skein::assemble
