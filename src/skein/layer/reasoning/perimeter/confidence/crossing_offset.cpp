// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/confidence/crossing_offset.h"

#include <algorithm>
#include <cmath>

namespace skein::perimeter {
namespace {

constexpr double kMinVariance = 1e-6;  // of a belief that says "exactly here" [m^2]
constexpr double kMaxSquare = 25;      // one crossing, however far off, counts as 5 sigma

// Where a place lies beside one piece of a believed boundary.
struct Beside {
  double off2;       // squared distance from the boundary [m^2]
  double variance;   // of the boundary there [m^2]
  Vec2 normal;       // of the piece
  double distance2;  // of the place to the piece's chord, squared [m^2]
};

// Slope at `point` of a curve through it that is nearly an arc, against the chord with
// unit vectors `along`, `normal`: 2 tan(angle/2) makes the cubic meet the arc at
// mid-chord.
double slope(const BoundaryPoint& point, const Vec2& along, const Vec2& normal) {
  const double cosine = point.normal.dot(normal);
  if (cosine < 0.5) return 0;  // a corner: the chord itself says more
  return -2 * point.normal.dot(along) / (1 + cosine);
}

// Between two points the boundary is the cubic through them with their normals: points
// may lie a kilometre apart on a large fire. All are carried on by `ahead` [s].
std::optional<Beside> beside(const Vec2& place, const BoundaryPoint& first,
                             const BoundaryPoint& second, double ahead) {
  const Vec2 from = first.position + ahead * first.rate * first.normal;
  const Vec2 to = second.position + ahead * second.rate * second.normal;
  const double length = (to - from).norm();
  if (!(length > 0)) return std::nullopt;
  const Vec2 along = (to - from) / length;
  Vec2 normal = geo::turned_right(along);
  if (normal.dot(first.normal + second.normal) < 0) normal = -normal;
  const double ahead_of_from = (place - from).dot(along) / length;
  const double u = std::clamp(ahead_of_from, 0.0, 1.0);
  const double bulge =
      length * u * (1 - u) *
      ((1 - u) * slope(first, along, normal) - u * slope(second, along, normal));
  const double growth = std::max(0.0, ahead);
  const double sigma = (1 - u) * (first.sigma + growth * first.sigma_growth) +
                       u * (second.sigma + growth * second.sigma_growth);
  const double off = (place - from).dot(normal) - bulge;
  const double distance2 = (place - from - u * length * along).squaredNorm();
  constexpr double kGuess = 0.05;  // how far a curve between points is off, of its bulge
  return Beside{u == ahead_of_from ? off * off : distance2,
                sigma * sigma + kGuess * kGuess * bulge * bulge, normal, distance2};
}

}  // namespace

double CrossingOffset::square() const {
  return std::min(off2 / variance, kMaxSquare);
}

std::optional<CrossingOffset> crossing_offset(const Crossing& crossing,
                                              const BoundaryEstimate& boundary) {
  const double ahead = (crossing.time - boundary.time).seconds();
  std::optional<Beside> nearest;
  for (const auto& ring : boundary.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto here =
          beside(crossing.point, ring[i], ring[(i + 1) % ring.size()], ahead);
      if (here && (!nearest || here->distance2 < nearest->distance2)) nearest = here;
    }
  if (!nearest) return std::nullopt;
  const double across = crossing.track.dot(nearest->normal);
  const double variance =
      nearest->variance + across * across / 12 + crossing.point_sd * crossing.point_sd;
  return CrossingOffset{nearest->off2, std::max(variance, kMinVariance)};
}

}  // namespace skein::perimeter
