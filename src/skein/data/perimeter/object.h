// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "skein/base/math.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/geo/vec.h"

namespace skein {

/// What a thing on the ground is, as far as a camera tells. It says how fast what is
/// known of it grows old.
enum class ObjectClass : std::uint8_t { kPerson, kAnimal, kVehicle, kStructure };

constexpr auto names_of(const ObjectClass*) {
  return std::to_array<std::string_view>({"person", "animal", "vehicle", "structure"});
}

/// A thing on the ground that cameras may find.
struct GroundObject {
  std::uint32_t id = 0;
  std::string name;
  ObjectClass what = ObjectClass::kPerson;
};

constexpr auto describe(const GroundObject*) {
  using T = GroundObject;
  return described<T>({"object", "objects"},
                      "A thing on the ground (environment.objects).",
                      field("object_id", &T::id, "which"),
                      field("name", &T::name, "as the scenario has it"),
                      field("class", &T::what, "what it is"));
}

/// The body of an object that exists in reality: an upright cylinder on the ground.
struct PhysicalObject {
  std::uint32_t id = 0;  ///< GroundObject::id
  double radius = 0;     ///< [m]
  double height = 0;     ///< [m]
};

constexpr auto describe(const PhysicalObject*) {
  using T = PhysicalObject;
  return described<T>(
      {"physical_object", "physical_objects"},
      "An object that exists in reality: an upright cylinder on the ground.",
      field("object_id", &T::id, "which"),
      field("radius", &T::radius, unit::kMetre, "of the cylinder"),
      field("height", &T::height, unit::kMetre, "above the ground"));
}

/// How large things of a class are, unless it is said [m].
constexpr PhysicalObject typical_body(ObjectClass what) {
  switch (what) {
    case ObjectClass::kPerson:
      return {0, 0.5, 2};
    case ObjectClass::kAnimal:
      return {0, 1, 1.5};
    case ObjectClass::kVehicle:
      return {0, 3, 3};
    case ObjectClass::kStructure:
      return {0, 5, 20};
  }
  return {};
}

/// An object as sensors may find it now.
struct VisibleObject {
  std::uint32_t id = 0;  ///< GroundObject::id
  ObjectClass what = ObjectClass::kPerson;
  Vec2 position = Vec2::Zero();  ///< [m]
};

/// Where an object truly is at one time, and how it moves.
struct ObjectMotion {
  Time time;
  std::uint32_t object = 0;      ///< GroundObject::id
  Vec2 position = Vec2::Zero();  ///< [m]
  Vec2 velocity = Vec2::Zero();  ///< over ground [m/s]

  /// Where it is at another time, if it goes on like this [m].
  Vec2 at(Time now) const { return position + (now - time).seconds() * velocity; }
};

constexpr auto describe(const ObjectMotion*) {
  using T = ObjectMotion;
  return described<T>(
      {"object_motion", "object_motions"},
      "How an object truly moves from now on, until the next of its rows.",
      field("time", &T::time, "from when on"), field("object_id", &T::object, "which"),
      field("", &T::position, axes::kPlace, "then"),
      field("", &T::velocity, axes::kVelocity, "over ground"));
}

/// Where somebody has seen an object.
struct ObjectSighting {
  std::uint32_t object = 0;  ///< GroundObject::id
  Time time;
  Vec2 position = Vec2::Zero();  ///< [m]
  double position_sd = 0;        ///< per axis [m]
  ObjectClass what = ObjectClass::kPerson;
};

constexpr auto describe(const ObjectSighting*) {
  using T = ObjectSighting;
  return described<T>({"sighting"}, "Where somebody has seen an object.",
                      field("object_id", &T::object, "which"),
                      field("time", &T::time, "when"),
                      field("", &T::position, axes::kPlace, "where it was believed"),
                      field("position_sd", &T::position_sd, unit::kMetre, "per axis"),
                      field("class", &T::what, "what it is"));
}

/// What is believed of an object.
struct ObjectBelief {
  std::uint32_t object = 0;      ///< GroundObject::id
  Time time;                     ///< of the last sighting
  Vec2 position = Vec2::Zero();  ///< then [m]
  Vec2 velocity = Vec2::Zero();  ///< [m/s]
  double position_sd = 0;        ///< per axis, then [m]
  double velocity_sd = 0;        ///< per axis [m/s]
  double persistence = 30;       ///< of the velocity: decays with this time constant [s]
  std::string mission = {};      ///< whose belief it is, in records

  /// Where it is believed to be at a time [m].
  Vec2 at(Time now) const {
    const double gone = (now - time).seconds() / persistence;
    return position - persistence * math::expm1(-gone) * velocity;
  }
  /// How it is believed to move at a time [m/s].
  Vec2 velocity_at(Time now) const {
    return math::exp(-(now - time).seconds() / persistence) * velocity;
  }
};

constexpr auto describe(const ObjectBelief*) {
  using T = ObjectBelief;
  return described<T>(
      {"object_belief"}, "What is believed of an object.",
      field("object_id", &T::object, "which"),
      field("seen", &T::time, "when it was last seen"),
      field("", &T::position, axes::kPlace, "then"),
      field("", &T::velocity, axes::kVelocity, "then"),
      field("position_sd", &T::position_sd, unit::kMetre, "per axis, then"),
      field("velocity_sd", &T::velocity_sd, unit::kMetrePerSecond, "per axis"),
      field("persistence", &T::persistence, unit::kSecond,
            "time constant with which the velocity decays"),
      field("mission", &T::mission, "whose belief it is"));
}

}  // namespace skein
