// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/edge_finder.h"

#include <algorithm>

namespace skein::sensory {

EdgeFinder::EdgeFinder(const EdgeFinderOptions& options)
    : options_(options), clock_(options.rate_hz) {}

void EdgeFinder::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (!clock_.due(view.now)) return;
  const Vec2 p = geo::horizontal(view.vehicle.p_N);
  double best = options_.range * options_.range;
  bool seen = false;
  EdgeSample sample;
  sample.time = view.now;
  if (options_.phenomenon >= view.phenomena.size()) return;
  for (const geo::Ring& ring : view.phenomena[options_.phenomenon]->region()) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2& from = ring[i];
      const Vec2 edge = ring[(i + 1) % ring.size()] - from;
      const double length2 = edge.squaredNorm();
      if (length2 == 0) continue;
      const double along = std::clamp((p - from).dot(edge) / length2, 0.0, 1.0);
      const Vec2 offset = from + along * edge - p;
      if (offset.squaredNorm() >= best) continue;
      best = offset.squaredNorm();
      seen = true;
      sample.offset = offset;
      // Outer rings run clockwise, holes counter-clockwise: the fire is right of both.
      sample.tangent = edge / std::sqrt(length2);
    }
  }
  if (seen) out.emplace_back(sample);
}

}  // namespace skein::sensory
