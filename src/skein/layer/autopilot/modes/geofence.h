// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "skein/geo/polygon.h"
#include "skein/geo/vec.h"

namespace skein::autopilot {

struct GeofenceOptions {
  /// To stay inside: positive rings, with negative ones for holes to stay out of; no two
  /// cross. Empty: no limit.
  geo::Region area;
  double ceiling_msl = std::numeric_limits<double>::infinity();  ///< [m]
  double floor_msl = -std::numeric_limits<double>::infinity();   ///< [m]
  double margin = 0;      ///< the fence stands this much further inside [m]
  double hysteresis = 5;  ///< further inside than this again to be back [m]
  double look_ahead =
      0;  ///< where the present velocity leads in this time counts too [s]
};

/// What is wrong with the options, naming the field; none when they can be used.
std::optional<std::string> error_in(const GeofenceOptions& options);

/// Where a vehicle may fly. Const; what one vehicle keeps of it is in FenceWatch.
class Geofence {
 public:
  /// `options` that are valid, see error_in().
  explicit Geofence(GeofenceOptions options);

  /// How far `p_N` is inside the fence: distance to the nearest edge, ceiling or floor,
  /// less the margin [m]. Negative outside, by the same measure; infinite without limits.
  ///
  /// Outside of several limits at once it is the distance to the furthest.
  /// Cost: linear in the points.
  double clearance(const Vec3& p_N, bool floor_counts) const;

  const GeofenceOptions& options() const { return options_; }

 private:
  double horizontal_clearance(const Vec2& p) const;

  GeofenceOptions options_;
};

/// Watches one vehicle. Clearance changes by no more than the distance flown, so that far
/// from the fence a step costs two distances.
class FenceWatch {
 public:
  /// `fence` must outlive this.
  explicit FenceWatch(const Geofence& fence) : fence_(&fence) {}

  /// Whether the vehicle is outside, or was and is not back inside by the hysteresis.
  ///
  /// @param floor_counts  false during take-off and landing, which cross the floor.
  bool step(const Vec3& p_N, const Vec3& v_N, bool floor_counts) {
    const double look_ahead = fence_->options().look_ahead;
    if (floor_counts == floor_counted_ && (p_N - anchor_).squaredNorm() < calm_ &&
        (p_N + look_ahead * v_N - anchor_).squaredNorm() < calm_) [[likely]]
      return outside_;
    return measure(p_N, v_N, floor_counts);
  }

 private:
  bool measure(const Vec3& p_N, const Vec3& v_N, bool floor_counts);

  const Geofence* fence_;
  Vec3 anchor_ = Vec3::Zero();
  double calm_ =
      0;  // square of the distance from the anchor in which nothing changes [m^2]
  bool outside_ = false;
  bool floor_counted_ = true;
};

}  // namespace skein::autopilot
