// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace skein::solve::test {

/// What became of the claims of planned paths that were checked.
struct PathTally {
  int problems = 0;
  int paths = 0;           ///< answers with a path
  int bounds = 0;          ///< answers with a bound above nothing
  int shortest = 0;        ///< paths that are called the shortest of their kind
  int parted = 0;          ///< goals that are called parted from the start by zones
  int false_bounds = 0;    ///< a flight of a point, or of the aircraft, is quicker
  int false_shortest = 0;  ///< of their kind there is a shorter one
  int false_parted = 0;    ///< there is a path
  int false_paths = 0;     ///< quicker than can be, deeper in a zone than is said
  int flights = 0;         ///< found by the independent search, to compare with
  int quicker = 0;         ///< of these: quicker than the planner's, which claims none
  std::string first;       ///< where the first fault was; empty: none

  void add(const PathTally& other);
  bool is_good() const {
    return false_bounds + false_shortest + false_parted + false_paths == 0;
  }
};

/// One random problem, by its number, planned by AaStar. What it claims is compared with
/// independent computations (independent_paths.h, independent_flights.h).
///
/// In turn: circles no smaller than the turn radius in still air; circles in wind up to
/// 0.95 of the airspeed; polygons; places on a lattice, so that circles, corners and ends
/// touch; goals behind rings of circles with narrow gaps or none; a polygon that two
/// paths lead around in the same time to 0.1 m; near goals in wind without obstacles;
/// climbs, and zones with floors and ceilings.
PathTally check_path_claims(std::uint32_t number);

}  // namespace skein::solve::test
