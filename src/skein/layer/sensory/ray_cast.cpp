// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/ray_cast.h"

#include <algorithm>

namespace skein::sensory {

std::optional<double> ray_cast(const Terrain& terrain, const Vec3& from_N,
                               const Vec3& ray_N, double reach, const RayMarch& march) {
  const auto clearance = [&](double distance) {
    const Vec3 p_N = from_N + distance * ray_N;
    return -p_N.z() - terrain.elevation_msl(geo::horizontal(p_N));
  };
  // How fast the ground can come closer, per metre along the ray.
  const double closing = ray_N.z() + march.steepest * geo::horizontal(ray_N).norm();
  double above = 0, under = 0;
  double room = clearance(0);
  if (room <= 0) return 0.0;
  if (closing <= 0) return std::nullopt;
  while (true) {
    if (above >= reach) return std::nullopt;
    under = std::min(above + std::max(room / closing, march.min_step), reach);
    room = clearance(under);
    if (room <= 0) break;
    above = under;
  }
  while (under - above > march.tolerance) {
    const double middle = (above + under) / 2;
    (clearance(middle) > 0 ? above : under) = middle;
  }
  return (above + under) / 2;
}

}  // namespace skein::sensory
