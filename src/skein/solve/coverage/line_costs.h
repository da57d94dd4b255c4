// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "skein/model/connection/connection.h"
#include "skein/solve/coverage/sweep_lines.h"
#include "skein/solve/coverage/watch.h"

namespace skein::solve {

/// A line, visit or aircraft as an index of an array.
inline std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// Where a route over lines begins and ends; without one of them it begins at its first,
/// or ends at its last line. Courses are headings of the air-relative velocity.
struct RouteEnds {
  std::optional<model::Pose> start, end;
};

/// Time lost beyond the free connection between two poses [s], 0 when nothing blocks it.
using DetourTime = std::function<double(const model::Pose& from, const model::Pose& to,
                                        const model::Connection& connection)>;

/// Exact times between lines in wind, each computed when first asked.
///
/// A *visit* is a line in one direction: 2 i from a to b of line i, 2 i + 1 from b to a,
/// so that `visit ^ 1` is the other direction. The places where aircraft k starts and
/// ends are numbered after the visits.
class LineCosts {
 public:
  /// Needs |wind| < airspeed. Memory: 8 bytes for each pair of visits.
  LineCosts(std::vector<SweepLine> lines, const model::AirMotion& air,
            std::vector<RouteEnds> ends, DetourTime detour = {}, Stop stop = {});

  int lines() const { return static_cast<int>(lines_.size()); }
  int aircraft() const { return static_cast<int>(ends_.size()); }
  int start_of(int aircraft) const { return 2 * lines() + 2 * aircraft; }
  int end_of(int aircraft) const { return start_of(aircraft) + 1; }

  const SweepLine& line(int visit) const {
    return lines_[static_cast<std::size_t>(visit / 2)];
  }
  const model::AirMotion& air() const { return air_; }
  const std::vector<SweepLine>& all_lines() const { return lines_; }
  const RouteEnds& ends(int aircraft) const {
    return ends_[static_cast<std::size_t>(aircraft)];
  }

  /// Whether no more time shall be spent on a better order.
  bool stopped() const { return stop_ && stop_(); }

  /// Time along a visit's line [s]; 0 for a start or an end.
  double along(int node) const { return along_[static_cast<std::size_t>(node)]; }

  /// Quickest connection from the end of one node to the beginning of another, and the
  /// time along that one [s]. 0 from or to an open start or end, but for the time along.
  double cost(int from, int to);
  /// Never more than `cost`, and quick.
  double min_cost(int from, int to) const;

  /// Poses at which a node begins and ends. Only for starts and ends that are given.
  model::Pose entry(int node) const;
  model::Pose exit(int node) const;

 private:
  bool open(int node) const;

  std::vector<SweepLine> lines_;
  model::AirMotion air_;
  std::vector<RouteEnds> ends_;
  DetourTime detour_;
  Stop stop_;
  double fastest_;
  std::vector<double> along_;
  std::vector<model::Pose> entries_, exits_;
  std::vector<double> memo_;
};

}  // namespace skein::solve
