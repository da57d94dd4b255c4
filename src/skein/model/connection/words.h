// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "skein/geo/vec.h"

// The six words in reduced form: the start is the origin with heading 0, lengths are in
// turn radii and the airspeed is 1, so that times and lengths are the same. A positive
// turn has growing heading. Words that begin with a negative turn are solved as their
// mirror images. Derivations are in docs/connection.md.
namespace skein::model::words {

inline constexpr double kTurn = 2 * std::numbers::pi;
inline constexpr double kNever = std::numeric_limits<double>::infinity();
// Outer turns this near to a full one are none: rounding of the heading at which a
// straight leaves the aircraft's own circle would add a spurious loop.
inline constexpr double kSnap = 1e-11;

/// Whether there is no wind, or so little that its square would lose its digits.
inline bool is_calm(const Vec2& wind, double airspeed) {
  return wind.squaredNorm() <= 1e-280 * airspeed * airspeed;
}

/// Where the goal is in some wind, reduced, with the sines that all words need.
struct Problem {
  Vec2 goal = Vec2::Zero();  ///< at time 0
  double phi = 0;            ///< heading at the goal, in [0, 2 pi)
  double sin_phi = 0, cos_phi = 1;
  Vec2 wind = Vec2::Zero();
  double wind2 = 0;  ///< squared, in (0, 1)

  /// The same for the turns exchanged.
  Problem mirrored() const;
  /// The vector from the first turn's centre (positive turn) to the last one's at time 0.
  Vec2 same_turns() const { return {goal.x() - sin_phi, goal.y() + cos_phi - 1}; }
  Vec2 opposite_turns() const { return {goal.x() + sin_phi, goal.y() - cos_phi - 1}; }
};

/// A meeting with the goal.
struct Meeting {
  double time = kNever;
  std::array<double, 3> parts{};
};

/// Goals further away than this [turn radii] count as no place: rounding would move them
/// by more than 1e-6.
inline constexpr double kFarthest = 1e9;

/// `angle` less whole turns, in [0, 2 pi), and 0 where it is within kSnap of 2 pi.
inline double turned(double angle) {
  double a = angle - kTurn * std::floor(angle / kTurn);
  if (a > kTurn - kSnap) a = 0;
  return a;
}

/// Earliest meetings before `best`, by two equal turns with a straight between, by two
/// opposite turns with a straight between, and by turns only. The first turn is positive.
Meeting equal_turns(const Problem& p, double best);
Meeting opposite_turns(const Problem& p, double best);
Meeting three_turns(const Problem& p, double best);

}  // namespace skein::model::words
