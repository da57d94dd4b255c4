// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/geo/vec.h"
#include "skein/role/terrain.h"

namespace skein::sensory {

/// How a ray is followed to the ground.
struct RayMarch {
  double steepest = 2;       ///< slope of the ground that is never exceeded [-]
  double min_step = 1;       ///< [m]; keeps a grazing ray moving
  double tolerance = 0.001;  ///< of the distance found [m]
};

/// Distance along a ray to where it first meets the ground, or none within `reach`.
///
/// Marches in steps that ground of no more than the steepest slope cannot be passed in:
/// clearance / (ray_z + steepest |ray_horizontal|); then halves the step that went under.
/// Where the ground is steeper, a step may pass through what is thinner than it.
///
/// @param from_N  [m]; at or under the ground the distance is 0.
/// @param ray_N   unit vector.
/// @param reach   [m]
/// Cost:    terrain look-ups: about 10, and one per step of a grazing ray.
std::optional<double> ray_cast(const Terrain& terrain, const Vec3& from_N,
                               const Vec3& ray_N, double reach,
                               const RayMarch& march = {});

}  // namespace skein::sensory
