// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/role/path_planner.h"

namespace skein::solve {

class AirspaceMap;

/// Paths of minimum time around obstacles: accelerated A* over manoeuvres, begun with
/// what a graph of tangents finds, bettered until the budget ends.
///
/// 1. The direct link; if it is free and regular, it is the best.
/// 2. Routes around zones (TangentGraph), flown exactly without wind and discs no smaller
///    than the turn radius, else followed by links; swerves around single conflicts;
///    circling until something has gone.
/// 3. Passes of accelerated A*, each with a finer step and a smaller heuristic weight,
/// and only for paths quicker than the best so far; each path is improved.
///
/// Ends as kFound when the path is at most `gap` slower than the bound, is the shortest
/// of tangents and arcs where those can be flown, or when the finest pass has nothing
/// left to look at; as kBudgetEnded with the best path otherwise.
///
/// No path is deeper than 0.1 m in a zone or another's room; see AirspaceMap for the
/// ground. The answer depends on the query alone unless `budget.stop` or
/// `budget.enough` end it.
class AaStar final : public PathPlanner {
 public:
  struct Options {
    bool detours = true;     ///< begin with routes around zones
    bool manoeuvres = true;  ///< search over manoeuvres
    double gap = 0.001;      ///< to the bound, at which nothing better is looked for
  };
  AaStar() = default;
  explicit AaStar(const Options& options) : options_(options) {}

  PlannedPath plan(const PathQuery& query) const override;
  /// The same with a map that is made already, of the same airspace, terrain and area;
  /// the query becomes the map's.
  PlannedPath plan(const PathQuery& query, AirspaceMap& map) const;

 private:
  Options options_;
};

/// Paths of straights and arcs along discs and corners, for what stands still: the
/// shortest of their kind, without wind and where no disc is smaller than the turn
/// radius; elsewhere followed by links.
class TangentGraph final : public PathPlanner {
 public:
  PlannedPath plan(const PathQuery& query) const override {
    return AaStar(AaStar::Options{true, false, 0.001}).plan(query);
  }
};

}  // namespace skein::solve
