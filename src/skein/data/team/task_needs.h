// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/data/describe/describe.h"
#include "skein/geo/vec.h"

namespace skein {

/// Bits of TeamResources::sensors, TeamTask::sensors and TaskNeeds::sensors.
enum TeamSensors : std::uint32_t {
  kCameraSensor = 1,
  kFireSensor = 2,
  kHovers = 4,  ///< no sensor: it can stay at a place
};

/// Where a task takes place, and what it takes of an aircraft that flies it alone.
struct TaskNeeds {
  std::optional<Vec2> begin = {};  ///< where it begins, N [m]; none: anywhere
  std::optional<Vec2> end = {};    ///< where it ends, N [m]; none: where it begins
  Vec2 centre = Vec2::Zero();      ///< of it, N [m]; of no place: the origin
  double length = 0;               ///< of the flight within it [m]
  double stay = 0;                 ///< besides [s]
  bool endless = false;            ///< until another order
  std::uint32_t sensors = 0;       ///< without which it cannot be flown
  bool better_hovering = false;    ///< about one place
  /// Where it leads follows from its values, not from what is met in flight.
  bool foreseen = true;
};

constexpr auto describe(const TaskNeeds*) {
  using T = TaskNeeds;
  return described<T>(
      {"task_needs"}, "Where a task takes place, and what it takes of an aircraft.",
      field("begin", &T::begin, axes::kPlace, "where it begins; null: anywhere"),
      field("end", &T::end, axes::kPlace, "where it ends; null: where it begins"),
      field("centre", &T::centre, axes::kPlace, "of it; of no place: the origin"),
      field("length", &T::length, unit::kMetre, "of the flight within it"),
      field("stay", &T::stay, unit::kSecond, "besides"),
      field("endless", &T::endless, "until another order"),
      field("sensors", &T::sensors, "a bit for each kind that it takes"),
      field("better_hovering", &T::better_hovering, "it is about one place"),
      field("foreseen", &T::foreseen, "where it leads follows from its values"));
}

}  // namespace skein
