// SPDX-License-Identifier: Apache-2.0
#include "skein/model/front/spacing.h"

#include <algorithm>

#include "skein/base/check.h"

namespace skein::model {
namespace {

// Height of the arc over edge b-c that passes on from a-b to c-d: the smaller of the two
// curvatures when they agree in sign. Turns that are really corners count as arcs of 60
// deg at most.
double arc_height(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 before = b - a, edge = c - b, after = d - c;
  const double length = edge.norm();
  const auto curvature = [&](const Vec2& in, const Vec2& out) {
    const double in_length = in.norm(), out_length = out.norm();
    if (!(in_length > 0 && out_length > 0) || in.dot(out) <= 0) return 0.0;
    return 2 * geo::cross(in, out) / (in_length * out_length * (in_length + out_length));
  };
  const double at_b = curvature(before, edge), at_c = curvature(edge, after);
  if (at_b * at_c <= 0) return 0;
  const double min = std::min(std::abs(at_b), std::abs(at_c));
  const double height = std::min(min * length * length / 8, 0.13 * length);
  return at_b > 0 ? height : -height;
}

// Copies `ring` without the markers that stand too close to a neighbour.
void thin(const geo::Ring& ring, double shortest, geo::Ring& out) {
  const double shortest2 = shortest * shortest;
  const auto n = ring.size();
  out.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& p = ring[i];
    if (out.empty() || (p - out.back()).squaredNorm() >= shortest2) {
      out.push_back(p);
      continue;
    }
    if (out.size() < 2) continue;
    const Vec2& last = out.back();
    const Vec2& before = out[out.size() - 2];
    const Vec2& next = i + 1 < n ? ring[i + 1] : out.front();
    const double area_last = std::abs(geo::cross(last - before, p - before));
    const double area_p = std::abs(geo::cross(p - last, next - last));
    if (area_last < area_p) out.back() = p;
  }
  while (out.size() > 3 && (out.back() - out.front()).squaredNorm() < shortest2)
    out.pop_back();
}

}  // namespace

void respace(geo::Ring& ring, double spacing, geo::Ring& scratch) {
  SKEIN_CHECK(spacing > 0 && ring.size() >= 3, spacing, ring.size());
  thin(ring, kShortestEdge * spacing, scratch);
  if (scratch.size() < 3) return;  // too small for this spacing: left as it is

  const double longest = kLongestEdge * spacing;
  const geo::Ring& thinned = scratch;
  const auto n = thinned.size();
  ring.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& b = thinned[i];
    const Vec2& c = thinned[(i + 1) % n];
    ring.push_back(b);
    const double length2 = (c - b).squaredNorm();
    if (length2 <= longest * longest) continue;
    const double length = std::sqrt(length2);
    const int parts = static_cast<int>(std::ceil(length / longest));
    const double height =
        arc_height(thinned[(i + n - 1) % n], b, c, thinned[(i + 2) % n]);
    const Vec2 out = geo::turned_left((c - b) / length);
    for (int k = 1; k < parts; ++k) {
      const double u = static_cast<double>(k) / parts;
      ring.push_back(b + u * (c - b) + 4 * u * (1 - u) * height * out);
    }
  }
}

}  // namespace skein::model
