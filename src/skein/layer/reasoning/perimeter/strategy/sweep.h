// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "skein/layer/reasoning/perimeter/strategy/boundary_line.h"
#include "skein/role/monitoring_strategy.h"

namespace skein::perimeter {

struct SweepOptions {
  double edge_angle = geo::radians(25);  ///< between course and edge [rad]
  double window = 120;        ///< plan this far ahead along the edge [s], and no further
                              ///< than the aircraft's even share of it
  double follow_speed = 15;   ///< progress along the edge while following it [m/s]
  double decide_period = 10;  ///< think about leaving the edge this often [s]
  double leave_ratio = 2.5;   ///< leave when elsewhere is this many times better
  double seen_again = 0.1;    ///< worth of a place, for each other that will see it [-]
  double commit = 60;         ///< stay at least this long with a new place [s]
};

/// Arc sweeps: every aircraft follows the real edge with its in/out sensor, on the arc
/// and in the direction that remove most uncertainty per second, counted over a window of
/// flight; what others will see counts a tenth for each of them. It cuts across to
/// another arc when that is clearly better. No two are sent to one point while there are
/// others.
///
///   value(arc) = sum over the arc's points of worth (sigma + sigma' t) ds / (t_go +
///   window)
class SweepStrategy : public MonitoringStrategy {
 public:
  explicit SweepStrategy(const SweepOptions& options);

  std::vector<Assignment> assign(const MonitoringSituation& situation) override;

 private:
  struct Sweep {
    bool clockwise = true;
    Time begun;
    Time decided;
    Time arrived_after;  ///< before this it is en route to the arc
    Vec2 start = Vec2::Zero();
  };
  struct Arc {
    std::size_t start = 0;
    bool clockwise = true;
    double t_go = 0;
    double value = 0;
  };

  // Who will see what of the line within the window.
  struct Seen {
    std::size_t aircraft = 0;
    double window_m = 0;  // looked ahead along the edge
    std::vector<int> by;  // how many will see each point
    std::vector<int> at;  // how many are there now, or en route there
  };

  // A place to begin at, and what no arc from there is worth more than.
  struct Start {
    std::size_t point = 0;
    double bound = 0;
  };

  double gain(const BoundaryLine& line, std::size_t start, bool clockwise, double t_go,
              const Seen& seen) const;
  double max_gain(const BoundaryLine& line, std::size_t start, bool clockwise,
                  double min_t_go, const Seen& seen) const;
  void count_seen(const BoundaryLine& line, const AircraftStatus& aircraft, Time now,
                  int change, Seen& seen) const;
  static std::size_t place_of(const BoundaryLine& line, const AircraftStatus& aircraft,
                              const Sweep& sweep, Time now);
  Arc best_arc(const BoundaryLine& line, const AircraftStatus& aircraft,
               std::span<const Zone> zones, const Seen& seen) const;
  Arc best_arc_from(std::vector<Start>& starts, const BoundaryLine& line,
                    const AircraftStatus& aircraft, std::span<const Zone> zones,
                    const Seen& seen) const;

  SweepOptions options_;
  std::map<EntityId, Sweep> sweeps_;
  std::vector<double> worth_;  // of a place that so many others will see
};

}  // namespace skein::perimeter
