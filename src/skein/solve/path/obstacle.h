// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/data/airspace/airspace.h"
#include "skein/geo/boundary_index.h"
#include "skein/solve/path/box_forest.h"
#include "skein/solve/path/sweep.h"

namespace skein::solve {

/// How deep a path may be in a zone or another's room and still count as outside [m], so
/// that a path may follow a border. With the error of chords that is at most 0.08 m.
inline constexpr double kDepth = 0.05;

/// A piece of an obstacle: a disc, a few edges of a ring, what lies inside of a ring,
/// something that moves, a piece of a planned flight.
struct Obstacle {
  enum class Kind : std::uint8_t { kDisc, kEdges, kInside, kMover, kFlight };
  Kind kind = Kind::kDisc;
  std::int32_t index = 0;  ///< in the airspace's list of its kind
  std::int32_t first = 0;  ///< edges: the first one
  std::int32_t count = 0;  ///< edges: how many
  /// Disc: the centre. Mover: where it is at `time`. Flight: begin and end of a chord.
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();
  Vec2 velocity = Vec2::Zero();  ///< mover [m/s]
  double radius = 0;             ///< disc, mover; flight: across, with the chord's error
  double low = 0, high = 0;      ///< altitudes [m]; mover: at `time`
  double climb = 0;              ///< mover [m/s]
  double altitude_a = 0, altitude_b = 0, height = 0;  ///< flight [m]
  double time = 0, end = 0;      ///< mover: of `a`; flight: of `a` and `b` [s]
  double ahead = 0, behind = 0;  ///< flight [s]
  double from = 0, until = 0;    ///< when there is anything [s]
};

/// What a zone, something that moves, and a planned flight consist of.
struct Pieces {
  std::vector<Obstacle> obstacles;
  std::vector<Box> boxes;  ///< of each
};
void add_pieces(const Zone& zone, std::int32_t index, Pieces& pieces);
void add_pieces(const MovingObstacle& mover, std::int32_t index, Pieces& pieces);
void add_pieces(const PlannedFlight& flight, std::int32_t index, Pieces& pieces);

/// The ring of a zone; one with many corners has an index.
struct RingShape {
  const geo::Ring* corners = nullptr;
  const geo::BoundaryIndex* index = nullptr;

  bool contains(const Vec2& p) const {
    return index != nullptr ? index->contains(p) : geo::contains(*corners, p);
  }
};

/// When an element first comes into an obstacle, deeper than kDepth.
///
/// - Disc, mover: straights and, without wind and motion, turns in closed form; else
///   pieces whose chord is within kChordError, in the frame that moves along.
/// - Edges: pieces likewise. Inside: whether the element begins inside.
/// - Flight: pieces of at most 0.05 s, for each of which the other may be anywhere where
///   it is in the whole piece's range of times.
///
/// @param ring  of the obstacle's zone, if it has one.
/// @param leaf  how exactly the time is needed [s]; infinite: only whether.
/// @returns     seconds after the element's start, at or shortly before the contact;
///              negative if there is none.
double first_contact(const Obstacle& obstacle, const RingShape& ring,
                     const FlightElement& element, double leaf);

}  // namespace skein::solve
