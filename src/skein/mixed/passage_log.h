// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein::mixed {

/// An upright cylinder.
struct Cylinder {
  Vec2 centre = Vec2::Zero();  ///< [m]
  double radius = 0;           ///< [m]
  double bottom_msl = 0;       ///< [m]
  double top_msl = 0;          ///< [m]

  /// How far a point is from it; 0 inside [m].
  double distance(const Vec3& p_N) const;
};

/// Where an aircraft was nearest to something.
struct Passage {
  EntityId aircraft;
  Time time;
  double distance = 0;  ///< [m]
};

/// Where aircraft have been, to be asked what they passed: a point each half second, the
/// last 20,000 of each (nearly three hours), joined by straight lines.
class PassageLog {
 public:
  static constexpr std::size_t kMaxPoints = 20000;

  /// In order of time. What comes sooner than half a second after the last is left out.
  void add(Time time, EntityId aircraft, const Vec3& p_N);

  /// Where each aircraft was nearest to `body` from `from` to `until`, if it was within
  /// `within` [m] of it; in order of aircraft. Cost: linear in the points of that time.
  std::vector<Passage> nearest(const Cylinder& body, Time from, Time until,
                               double within) const;

 private:
  struct Point {
    Time time;
    Vec3 p_N;
  };
  std::map<EntityId, std::deque<Point>> tracks_;
};

}  // namespace skein::mixed
