// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/perimeter/object.h"
#include "skein/geo/vec.h"

// What is known of the physical world, and who may say so. In a mixed run some things
// exist in reality, others only in the simulation.

namespace skein {

/// Which of the two worlds.
enum class Reality : std::uint8_t { kNone, kVirtual, kPhysical, kBoth };

constexpr auto names_of(const Reality*) {
  return std::to_array<std::string_view>({"none", "virtual", "physical", "both"});
}

/// Where an entity stands in the extended MiRA cube.
/// Reference: [Selecky18] section 5.2.
struct EntityReality {
  /// Corporeal presence: the world that its body is in.
  Reality presence = Reality::kVirtual;
  /// Interactive capacity: the worlds that it perceives.
  Reality interaction = Reality::kNone;
  /// Update capability: the worlds of which it may refresh what the server knows.
  Reality updates = Reality::kNone;

  friend constexpr bool operator==(const EntityReality&, const EntityReality&) = default;
};

constexpr auto describe(const EntityReality*) {
  using T = EntityReality;
  return described<T>(
      {"entity_reality"}, "Where an entity stands between the physical and the virtual.",
      field("presence", &T::presence,
            "corporeal presence: the world that its body is in"),
      field("interaction", &T::interaction,
            "interactive capacity: the worlds that it perceives"),
      field(
          "updates", &T::updates,
          "update capability: the worlds of which it may refresh what the server knows"));
}

constexpr bool includes_physical(Reality reality) {
  return reality == Reality::kPhysical || reality == Reality::kBoth;
}

/// Of an entity with a body in `presence` that perceives `interaction`: what is virtual
/// never refreshes what is known of the physical world.
constexpr EntityReality entity_reality(Reality presence, Reality interaction) {
  const bool physical = presence == Reality::kPhysical;
  return {presence, interaction,
          physical || interaction == Reality::kNone ? interaction : Reality::kVirtual};
}

/// What entities of that kind are called.
constexpr std::string_view class_of(const EntityReality& entity) {
  const bool real = entity.presence == Reality::kPhysical;
  switch (entity.interaction) {
    case Reality::kNone:
      return "no-sensors";
    case Reality::kVirtual:
      return real ? "real-virtual-payload" : "pure-simulated";
    case Reality::kPhysical:
      return real ? "pure-real" : "simulated-mixed";
    case Reality::kBoth:
      return real ? "real-mixed" : "simulated-mixed";
  }
  return "";
}

/// Where an object was seen, by whom.
struct Observation {
  std::uint32_t object = 0;      ///< GroundObject::id
  Time time;                     ///< of the picture
  Vec2 position = Vec2::Zero();  ///< [m]
  double position_sd = 0;        ///< per axis [m]
  ObjectClass what = ObjectClass::kPerson;
  EntityId observer;
  Reality source = Reality::kVirtual;  ///< of the sensor: physical or virtual
};

constexpr auto describe(const Observation*) {
  using T = Observation;
  return described<T>({"observation"}, "Where an object was seen, by whom.",
                      field("object_id", &T::object, "what was seen"),
                      field("seen", &T::time, "when"),
                      field("", &T::position, axes::kPlace, "where"),
                      field("position_sd", &T::position_sd, unit::kMetre, "per axis"),
                      field("class", &T::what, "what it is"),
                      field("entity_id", &T::observer, "who saw it"),
                      field("source", &T::source, "of the sensor: physical or virtual"));
}

/// What becomes of an observation in the server's memory.
enum class ObservationFate : std::uint8_t {
  kRemembered,  ///< it is the newest of its object
  kLate,        ///< a newer one is known
  kRefused,     ///< whoever made it may not refresh what is known of the object
  kExpired,     ///< forgotten: too old
  kNotFound,    ///< forgotten: a physical sensor looked there and did not find it
};

inline constexpr std::size_t kObservationFates = 5;

constexpr auto names_of(const ObservationFate*) {
  return std::to_array<std::string_view>(
      {"remembered", "late", "refused", "expired", "not-found"});
}

/// How fast things of a class change.
enum class RateOfChange : std::uint8_t { kStable, kUnstable };

/// What makes an observation be forgotten.
enum class ForgettingModel : std::uint8_t {
  kTemporal,  ///< its age
  kLogical,   ///< looks at its place that did not find it
};

/// When the server forgets what it was told of the physical world.
struct ForgettingRules {
  ForgettingModel model = ForgettingModel::kTemporal;
  std::vector<ObjectClass> stable = {ObjectClass::kStructure};  ///< all else is unstable
  /// Temporal: of each ObjectClass; none: never forgotten.
  std::array<std::optional<Time>, 4> max_age = {
      Time::from_seconds(600), Time::from_seconds(300), Time::from_seconds(300), {}};
  /// Looks in vain, one after the other, after which it is not there. A camera misses an
  /// object now and then.
  int unstable_looks = 1;
  int stable_looks = 3;

  RateOfChange rate_of(ObjectClass what) const {
    for (const ObjectClass each : stable)
      if (each == what) return RateOfChange::kStable;
    return RateOfChange::kUnstable;
  }
  int looks(ObjectClass what) const {
    return rate_of(what) == RateOfChange::kStable ? stable_looks : unstable_looks;
  }
  std::optional<Time> max_age_of(ObjectClass what) const {
    return max_age[static_cast<std::size_t>(what)];
  }
};

}  // namespace skein
