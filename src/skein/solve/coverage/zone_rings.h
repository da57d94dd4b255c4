// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "skein/data/vehicle/flight_plan.h"
#include "skein/geo/polygon.h"

namespace skein::solve {

/// A part of a line, from one distance along it to another [m].
struct Span {
  double low = 0, high = 0;
};

/// What surveys keep out of: rings with boxes around them and around runs of their edges,
/// so that most questions are answered without a look at their corners.
class ZoneRings {
 public:
  ZoneRings() = default;
  /// @param rings  positive, of 3 corners or more.
  explicit ZoneRings(std::vector<geo::Ring> rings);

  bool empty() const { return rings_.empty(); }
  const std::vector<geo::Ring>& rings() const { return rings_; }

  /// Where the line from `a` along unit vector `t` is within `distance` [m] of a ring, or
  /// inside of it; each part of a ring adds a span of its own.
  void near(const Vec2& a, const Vec2& t, double distance, std::vector<Span>& out) const;

  /// Whether a polyline enters a ring.
  bool entered_by(std::span<const Vec2> points) const;
  /// Whether the ground track of a plan does, turns taken as chords that leave it by no
  /// more than 5 cm.
  bool entered_by(const FlightPlan& plan) const;

 private:
  struct Box {
    Vec2 min, max;
  };

  static constexpr std::size_t kRun = 16;  // edges

  static Box box_of(const geo::Ring& ring, std::size_t from, std::size_t count);
  bool inside(const Vec2& p) const;
  bool crossed_by(const Vec2& a, const Vec2& b) const;

  std::vector<geo::Ring> rings_;
  std::vector<Box> boxes_;
  std::vector<std::vector<Box>> runs_;  // of each ring
};

}  // namespace skein::solve
