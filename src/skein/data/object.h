#pragma once

#include <cstdint>
#include <string>

#include "skein/base/time.h"
#include "skein/data/describe.h"
#include "skein/geo/vec.h"

namespace skein {

/// A thing on the ground that cameras may find: a person, a car. Moves evenly.
struct GroundObject {
  std::uint32_t id = 0;
  std::string name;
  Vec2 position = Vec2::Zero();  ///< at time 0 [m]
  Vec2 velocity = Vec2::Zero();  ///< [m/s]

  Vec2 at(Time now) const { return position + now.seconds() * velocity; }
};

constexpr auto describe(const GroundObject*) {
  using T = GroundObject;
  return described<T>({"object", "objects"},
                      "A thing on the ground (environment.objects); it moves evenly.",
                      field("object_id", &T::id, "which"),
                      field("name", &T::name, "as the scenario has it"),
                      field("", &T::position, axes::kPlace, "at time 0"),
                      field("", &T::velocity, axes::kVelocity, "over ground"));
}

/// Where somebody has seen an object.
struct ObjectSighting {
  std::uint32_t object = 0;  ///< GroundObject::id
  Time time;
  Vec2 position = Vec2::Zero();  ///< [m]
  double position_sd = 0;        ///< per axis [m]
};

constexpr auto describe(const ObjectSighting*) {
  using T = ObjectSighting;
  return described<T>({"sighting"}, "Where somebody has seen an object.",
                      field("object_id", &T::object, "which"),
                      field("time", &T::time, "when"),
                      field("", &T::position, axes::kPlace, "where it was believed"),
                      field("position_sd", &T::position_sd, unit::kMetre, "per axis"));
}

}  // namespace skein
