// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/autopilot.h"
#include "skein/model/path/path_cursor.h"

namespace skein::autopilot {

/// How the corners of a route are flown.
struct CornerRule {
  /// Turns begin before the corner, on an arc of this radius [m]; 0 = none: the point is
  /// flown over, and the turn follows.
  double radius = 0;
  /// Or: an arc that passes this far inside of the corner [m]; counts when radius is 0.
  double cut = 0;
};

/// Waypoints as a line to follow, leg by leg.
///
/// Two legs and their corners are laid out at a time, so that laps cost no memory and a
/// new rule (another wind) holds from the next corner on that is still ahead. With turn
/// angle D the arc of a corner begins radius tan(D/2) before it; a cut c gives radius = c
/// / (1/cos(D/2) - 1). An arc that would take more than half of a leg is left out (with
/// `cut`: made smaller). Altitude changes evenly with the distance from the middle of one
/// corner to the next.
class WaypointRoute {
 public:
  /// @param command  at least one point, at least one lap.
  /// @param from     where the first leg begins.
  void begin(const FlyWaypoints& command, const Vec3& from, const CornerRule& rule);
  void set_rule(const CornerRule& rule);

  /// Where the vehicle is on the route. Goes on to the next leg when one is done.
  ///
  /// @param window  only this far behind and five times as far ahead is looked [m].
  struct Place {
    model::PathCursor::Place on_path;
    double altitude_msl = 0;  ///< of the route there [m]
    double slope = 0;         ///< of the altitude: rise over distance
    double remaining = 0;     ///< to the last point [m]
    bool done = false;        ///< the last point has been passed
  };
  Place project(const Vec2& p, double window);

  /// The legs laid out, with arc lengths as in Place::on_path.
  const model::PathCursor& cursor() const { return cursor_; }
  /// Arc length of the corner to which the layout leads without an arc [m], where it is
  /// sharp; else its end. At the last point of all the same.
  double stop_at() const { return cursor_.length(); }
  bool on_last_leg() const { return leg_ + 1 >= legs_; }

  /// The point at which the route ends.
  const FlyWaypoints::Waypoint& last() const { return points_.back(); }
  /// The leg that is flown, from 0.
  long leg() const { return leg_; }
  /// Laps that have been completed, the last only when place.done has been.
  int lap() const { return static_cast<int>(leg_ / static_cast<long>(points_.size())); }
  int laps() const { return static_cast<int>(legs_ / static_cast<long>(points_.size())); }

 private:
  struct Corner {
    double radius = 0, length = 0, tangent = 0;  // of the arc; along each leg [m]
    double side = 1;
  };
  FlyWaypoints::Waypoint point(long leg) const;  // at the end of a leg
  Corner corner_after(long leg) const;
  void lay_out();

  std::vector<FlyWaypoints::Waypoint> points_;
  FlyWaypoints::Waypoint from_;
  CornerRule rule_;
  long leg_ = 0, legs_ = 0;
  Corner before_, after_;  // of the current leg
  model::PathCursor cursor_;
  Path layout_;
  double along_ = 0;
  double straight_ = 0;  // of the current leg between its corners' arcs [m]
  double leg_length_ = 0,
         leg_length_next_ = 0;  // of this leg and the next, half arcs included [m]
  double beyond_ = 0;           // legs after the current one [m]
};

}  // namespace skein::autopilot
