// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "skein/data/vehicle/plan.h"
#include "skein/model/path/path_cursor.h"

namespace skein::model {

/// A plan as a curve over time that can be evaluated and projected onto quickly.
///
/// Between points i and i+1, with u = (t - t_i) / h, h = t_{i+1} - t_i:
///
///   p(t) = (2u^3 - 3u^2 + 1) p_i + (u^3 - 2u^2 + u) h v_i
///          + (3u^2 - 2u^3) p_{i+1} + (u^3 - u^2) h v_{i+1}
///
/// Before its first and after its last time it goes straight on at the velocity there.
/// Times are seconds of the run's clock. Not to be used while empty.
class PlanCurve {
 public:
  PlanCurve() = default;

  /// Takes another plan; its times must grow.
  void assign(const Plan& plan);

  bool empty() const { return segments_.empty(); }
  double start() const { return start_; }  ///< [s]
  double end() const { return end_; }      ///< [s]

  struct State {
    Vec3 p_N, v_N, a_N;  ///< [m], [m/s], [m/s^2]
  };
  State at(double time) const;

  /// The course of the curve in the horizontal plane; where it stands still, the last one
  /// is not known and north is given, without curvature.
  static TrackPoint track(const State& state);

  /// Time of the curve's point that is nearest to `p` in the horizontal plane, among
  /// those that are reached by following the distance down from `time`: one step of Gauss
  /// and Newton,
  ///
  ///   t' = t + (p - p(t)) . v / max(v.v - (p - p(t)) . a, v.v / 2)
  ///
  /// of at most half a second. Called at each step of a flight it keeps within
  /// millimetres of the nearest point. Where the curve stands still it returns `time`.
  double follow(const Vec2& p, double time) const;

  /// The time in [from, to] of the nearest point, by looking at every `step` seconds and
  /// refining the best with `follow`: for the start, and after being carried away.
  double nearest(const Vec2& p, double from, double to, double step) const;

  /// Horizontal length from there to the end [m]: eight chords a segment, and even
  /// progress in time within a segment.
  double remaining(double time) const;

 private:
  struct Segment {
    double begin, span;    // [s]
    Vec3 c0, c1, c2, c3;   // p = c0 + c1 s + c2 s^2 + c3 s^3, s = t - begin
    double length, after;  // of the segment, and of all behind it [m]
  };
  std::size_t index_at(double time) const;

  std::vector<Segment> segments_;
  double start_ = 0, end_ = 0;
  mutable std::size_t current_ = 0;  // where the last call looked: only for speed
};

}  // namespace skein::model
