// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/safety_zone.h"

namespace skein::separation {

/// Two flights where they are nearest to each other.
struct NearestPair {
  std::size_t a = 0, b = 0;  ///< numbers of the flights
  double time = 0;           ///< of flight `a` [s]
  double distance = 0;       ///< [m]
};

/// How far flights keep from each other.
struct Separation {
  /// Straight from one to the other, both in the air at the same time; none where no two
  /// ever are.
  std::optional<NearestPair> nearest;
  /// Level distance of `a` from where `b` is at any time of the room, no more than the
  /// room's height above or below; none where that is never below `kRoomsLookedAt` rooms.
  std::optional<NearestPair> nearest_room;
  std::int64_t pairs_in_rooms = 0;  ///< of which one comes into the other's room
  std::int64_t pairs = 0;           ///< looked at
};

/// The room about a flight, and how it is looked at.
struct SeparationOptions {
  SafetyZone zone;
  double height = 20;  ///< of the room, up and down [m]
  double step = 0.1;   ///< between samples [s]
  /// As deep in a room still counts as outside [m].
  double tolerance = 0.1;
  /// Asked now and then; true ends the look with what is known by then.
  std::function<bool()> stop = {};
};

/// Rooms farther apart than so many times `across` are not measured.
inline constexpr double kRoomsLookedAt = 10;

/// Looks at each pair of flights in steps of time. A flight is in another's room where it
/// is within `across` of where the other is at a time from `behind` before to `ahead`
/// after, and within `height` of it.
///
/// This is a check of planners: nothing in it is theirs. Places follow from the elements
/// by chords, and what is skipped is only what neither flight can reach at its speed.
///
/// @param flights  empty ones are left out.
/// Cost: of N flights N² / 2 looks, and a sample each `step` where two are close.
Separation separation_of(std::span<const FlightPlan> flights,
                         const SeparationOptions& options);

}  // namespace skein::separation
