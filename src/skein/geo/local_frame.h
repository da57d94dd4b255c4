// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/base/result.h"
#include "skein/geo/vec.h"

namespace skein::geo {

/// A position on the WGS 84 ellipsoid.
struct Geodetic {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double height_m = 0;  ///< above the ellipsoid
};

/// The local frame N of a run: a plane that touches the ellipsoid at the origin, axes
/// north, east, down. Immutable; copies share the same frame.
class LocalFrame {
 public:
  /// Fails: kBadInput when the latitude is outside [-90, 90] or a number is not finite.
  static Result<LocalFrame> at(const Geodetic& origin);

  const Geodetic& origin() const { return origin_; }

  /// Position in N [m]. Exact on the ellipsoid: 10 km away, the ground falls 7.8 m below
  /// the plane. Reference: Karney, GeographicLib::LocalCartesian.
  Vec3 to_local(const Geodetic& position) const;
  Geodetic to_geodetic(const Vec3& p_N) const;

  /// As to_local for a map point: the horizontal part, for height 0.
  Vec2 to_plane(double latitude_deg, double longitude_deg) const;
  /// The geodetic point, at the origin's height, whose horizontal position is `p`.
  Geodetic from_plane(const Vec2& p) const;

 private:
  struct Projection;
  LocalFrame(const Geodetic& origin, std::shared_ptr<const Projection> projection);

  Geodetic origin_;
  std::shared_ptr<const Projection> projection_;
};

}  // namespace skein::geo
