// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "skein/solve/path/test/independent_paths.h"

// Flights of bounded curvature in wind, by means of their own: no code is shared with
// planners and connections.
namespace independent {

/// Three parts, each a turn (+1 right, -1 left) or straight on (0), as lengths through
/// the air.
struct Word {
  std::array<int, 3> turn{};
  std::array<Real, 3> part{};
  Real length = 0;
};

/// The shortest of the six words of turns and straights between two poses in still air
/// ([Dubins57]); infinite length when there is none.
Word shortest_word(Pose from, Pose to, Real radius);

/// The earliest flight of one word to a goal in wind.
struct Meeting {
  Word word;  ///< through the air
  Real time = 0;
  /// Until then the goal, as the drifting aircraft sees it, stays further away than four
  /// turn radii: the length of the shortest word then changes without jumps, and no other
  /// flight is quicker.
  bool regular = false;
};
/// Nothing where the length of the shortest word jumps past the time flown.
std::optional<Meeting> earliest_meeting(const Air& air, Pose from, Pose to, Real radius);

/// A flight between two poses around obstacles, found by a search over a lattice of poses
/// with turns and straights of a fixed length, each ended by `earliest_meeting`.
/// @param step    length of one manoeuvre, in turn radii.
/// @param states  that are looked at, at most.
/// @returns  its time, infinite when none was found: a flight of this time exists.
Real lattice_time(const Field& field, const Air& air, Pose from, Pose to, Real radius,
                  Real step, int states);

}  // namespace independent
