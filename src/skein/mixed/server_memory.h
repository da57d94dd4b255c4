// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "skein/mixed/observation_memory.h"
#include "skein/mixed/passage_log.h"
#include "skein/role/terrain.h"
#include "skein/role/world_memory.h"

namespace skein::mixed {

/// An object that exists in reality, as the scenario describes it.
struct KnownObject {
  GroundObject object;
  PhysicalObject body;
};

struct ServerMemoryOptions {
  ForgettingRules forgetting;
  /// What is seen further from where it was remembered has moved, besides three standard
  /// deviations of both places [m].
  double moved = 5;
  /// What passes an object nearer than this, would have met it [m].
  double safety_radius = 10;
};

/// An entity, as far as this is about it.
struct KnownEntity {
  std::string name;
  EntityReality reality;
};

/// The server's memory of the physical world, and the two ways in which it may be wrong:
///
/// - *non-actual observation*: a virtual entity has relied on what is remembered, and the
///   object is seen elsewhere, or is not found where it was remembered;
/// - *unknown object interaction*: a stable object is seen for the first time, or again
///   after it was forgotten, and while it was unknown a virtual entity passed it nearer
///   than the safety radius.
///
/// Events: "non-actual-observation" (of who found out), "unknown-object-interaction" (of
/// who passed), "update-refused" (of whoever saw a remembered object, once for each
/// object), "forgotten" (of who saw it last).
///
/// A place counts as looked at when it is in the picture, further from its edge than
/// twice the standard deviation of the remembered place. Hills that hide it are not
/// looked for.
/// Reference: [Selecky18] section 5.2.
class ServerMemory final : public WorldMemory {
 public:
  /// @param objects   all that are physical.
  /// @param entities  all of the run, by id.
  /// @param terrain   on which objects stand.
  ServerMemory(const ServerMemoryOptions& options,
               const std::vector<KnownObject>& objects, std::vector<KnownEntity> entities,
               std::shared_ptr<const Terrain> terrain);

  void begin_step(Time now) override;
  void take_position(Time now, EntityId aircraft, const Vec3& p_N) override;
  void take_payload(Time now, EntityId aircraft, std::span<const Footprint> pictures,
                    std::span<const Detection> detections) override;
  std::span<const VisibleObject> remembered() const override { return visible_; }
  void take_news(std::vector<ObservationRecord>& observations,
                 std::vector<Event>& events) override;

 private:
  struct Known {
    KnownObject what;
    bool stable = false;
    Time unknown_since;
    std::map<EntityId, Time> relied;  // who has seen the newest memory of it, since when
  };

  void see(Time now, const Detection& detection, Known& known);
  void refuse(Time now, const Observation& observation, Known& known);
  void compare(Time now, const Observation& before, const Observation& seen,
               Known& known);
  void find_passages(Time now, const Observation& seen, const Known& known);
  void look(Time now, EntityId aircraft, const Footprint& picture);
  void miss(Time now, EntityId aircraft, Time picture, Known& known);
  void forget(Time now, const Observation& last, ObservationFate fate, Known& known);
  void report_reliance(Time now, EntityId finder, const std::string& found,
                       const Observation& remembered, Known& known);
  const std::string& name_of(EntityId entity) const;
  bool any_stable_unknown() const;
  void refresh();

  ServerMemoryOptions options_;
  std::vector<KnownEntity> entities_;
  std::shared_ptr<const Terrain> terrain_;
  ObservationMemory memory_;
  PassageLog passages_;
  std::map<std::uint32_t, Known> objects_;
  std::set<std::pair<EntityId, std::uint32_t>> refused_;  // reported
  std::vector<VisibleObject> visible_;
  std::vector<ObservationRecord> observations_;
  std::vector<Event> events_;
};

}  // namespace skein::mixed
