// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/environment/fire/bearing_profile.h"
#include "skein/layer/environment/fire/region_lookup.h"
#include "skein/role/phenomenon.h"
#include "skein/role/terrain.h"

namespace skein::environment {

struct ThesisFireOptions {
  Vec2 origin = Vec2::Zero();  ///< where bearings are taken from [m]
  int points = 360;            ///< of the boundary at the start; the thesis has 60
  double start_radius = 500;   ///< [m]
  double displacement = 180;   ///< largest departure of the start from that circle [m]
  int displacement_harmonics = 5;  ///< of that departure over bearing; 0: none
  double rate = 3;                 ///< spread [m/s]
  double rate_error = 0.1;         ///< largest departure from that rate [m/s]
  int rate_harmonics = 8;          ///< of that departure over bearing; 0: none
  int rate_sectors = 0;  ///< above 0: a rate per equal sector instead of harmonics
  double harmonic_decay = 1.75;  ///< sizes fall as order^-decay, see BearingProfile
  Vec2 wind = Vec2::Zero();      ///< drift of every boundary point [m/s]
  double slope_weight = 0;       ///< effect of slope: 1 makes 30 % of rise 30 % of rate
  double step = 1;               ///< of the integration [s]
  bool respace = true;           ///< add points where they have drawn apart
};

/// Fails: kBadInput when a value is not finite or outside its range.
Result<void> check(const ThesisFireOptions& options);

/// The fire of the thesis: a boundary whose points run away from the fire's origin and
/// with the wind.
///
///   p' = V (1 + w s) (cos psi, sin psi) + W
///
/// psi is the bearing of p from the origin, V the rate at that bearing, w the slope
/// weight, s the rise of the ground per distance towards psi, within +-1, and W the wind.
/// Points are integrated by Runge-Kutta's fourth order over whole steps since the start,
/// and from the last of these to the time asked for: the boundary of a time does not
/// depend on the times asked for before. A point that is added later starts on the start
/// boundary like all others: it is as exact as they are.
///
/// Where points would cross (a wind stronger than the spread drives them over the
/// origin), the region is what the boundary still surrounds clockwise.
///
/// Reference: [Rabinovich18] Eq. (4.2).
class ThesisFire : public Phenomenon {
 public:
  /// @param seed     of the random start and rates.
  /// @param terrain  outlives the fire; asked only when the slope has weight.
  /// Fails: Bug when the options do not pass check().
  ThesisFire(const ThesisFireOptions& options, std::uint64_t seed,
             const Terrain& terrain);

  void advance(Time time) override;
  bool inside(const Vec2& p) const override { return lookup_.inside(region_, p); }
  const geo::Region& region() const override { return region_; }

  /// The start boundary's distance from the origin and the rate at a bearing [rad].
  double start_radius(double bearing) const;
  double rate(double bearing) const;

 private:
  struct Point {
    double bearing;  // where it started from [rad], growing along the boundary
    Vec2 p;
  };
  Vec2 velocity(const Vec2& p) const;
  void move(Vec2& p, double dt) const;
  Point start_point(double bearing) const;
  void add_points();
  void update_region(double since);

  ThesisFireOptions options_;
  const Terrain& terrain_;
  BearingProfile shape_, rate_;
  std::vector<Point> points_;  // at the last whole step
  std::int64_t steps_ = 0;     // done
  Time shown_;                 // of the region
  geo::Region region_;
  RegionLookup lookup_;
};

}  // namespace skein::environment
