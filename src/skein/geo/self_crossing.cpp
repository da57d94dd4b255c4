// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/self_crossing.h"

namespace skein::geo {

std::optional<SelfCrossing> self_crossing(std::span<const Vec2> ring) {
  const std::size_t n = ring.size();
  const auto end = [&](std::size_t i) -> const Vec2& { return ring[(i + 1) % n]; };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) {
      const Vec2 along = end(i) - ring[i], other = end(k) - ring[k];
      // The ends of each edge lie on different sides of the other one.
      const double from = cross(along, ring[k] - ring[i]);
      const double to = cross(along, end(k) - ring[i]);
      if (from * to >= 0) continue;
      const double begin = cross(other, ring[i] - ring[k]);
      const double finish = cross(other, end(i) - ring[k]);
      if (begin * finish >= 0) continue;
      return SelfCrossing{ring[i] + begin / (begin - finish) * along, i, k};
    }
  return std::nullopt;
}

}  // namespace skein::geo
