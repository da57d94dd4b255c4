// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "skein/data/vehicle/path.h"

namespace skein::model {

/// A point of a line that is followed, with what is needed to follow it.
struct TrackPoint {
  Vec2 position = Vec2::Zero();  ///< [m]
  Vec2 tangent = Vec2(1, 0);     ///< unit vector along the line
  double curvature = 0;          ///< [1/m], right positive
};

/// A path made ready to be followed step by step: directions and centres are worked out
/// once, and the search for the nearest point begins where the last one ended.
///
/// Gives what `project` and `pose_at` of path_geometry.h give, up to rounding.
class PathCursor {
 public:
  PathCursor() = default;

  /// Takes another path, and goes to its start. Allocates only when it is longer than
  /// those before.
  void assign(const Path& path);

  bool empty() const { return elements_.empty(); }
  double length() const { return length_; }  ///< [m]

  /// Where a position is, seen from the path.
  struct Place {
    double along = 0;        ///< arc length of the nearest point [m]
    double remaining = 0;    ///< from there to the path's end [m]
    double cross_track = 0;  ///< across the path there, right positive [m]
    double course = 0;       ///< of the path there, not wrapped [rad]
    TrackPoint point;
  };

  /// Goes to the nearest point of those whose arc length lies in [from, to].
  /// Fails: Bug when the path is empty. Cost: elements that cannot be nearest take a
  /// square root; one or two others an angle each.
  Place project(const Vec2& p, double from, double to);

  /// The point at arc length `s` [m]; beyond its ends the path goes straight on.
  /// Fails: Bug when the path is empty.
  TrackPoint at(double s) const;

  /// Curvature [1/m] at arc length `s`; 0 outside the path.
  double curvature_at(double s) const;

  /// Largest absolute curvature in the arc lengths from `from` to `to` [1/m].
  double tightest(double from, double to) const;

  /// The largest speed at `along`, up to `max`, from which each turn ahead can be
  /// entered and flown with lateral acceleration `lateral`, braking at `braking` before
  /// it:
  ///
  ///   V^2 <= lateral / curvature + 2 braking (distance to the turn)
  double speed_limit(double along, double lateral, double braking, double max) const;

 private:
  struct Element {
    Vec2 start, tangent;  // tangent at the start
    Vec2 centre;          // of an arc
    double radius;        // of an arc; 0 of a straight
    double side;          // +1 turns right, -1 left
    double curvature, course, length;
    double begin;  // arc length of the start along the path
  };
  struct Candidate {
    double s = 0;  // along the element
    double distance2 = 0;
    bool beside = false;  // of an arc, not clamped: p lies on its radius through s
  };
  static Candidate nearest_on(const Element& e, const Vec2& p, double low, double high,
                              double best);
  static TrackPoint point_of(const Element& e, double s);
  std::size_t index_at(double s) const;

  std::vector<Element> elements_;
  double length_ = 0;
  std::size_t current_ = 0;
};

}  // namespace skein::model
