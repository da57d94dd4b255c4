#include "layer/reasoning/monitoring/coordinator/confidence_monitor.h"

#include <algorithm>
#include <cmath>

namespace skein::monitoring {
namespace {

constexpr std::size_t kRecent = 20;  // crossings that are judged together
// Of 20 crossings of an honest belief one lies outside; 8 or more once in a million. A
// belief is trusted again well below that, so that the verdict does not flicker.
constexpr double kTooMany = 0.4, kFewEnough = 0.2;

// Where a place lies beside one piece of a believed boundary.
struct Beside {
  double off;        // outwards from the boundary [m]
  double sigma;      // of the boundary there [m]
  Vec2 normal;       // of the piece
  double distance2;  // of the place to the piece's chord, squared [m^2]
};

// Slope of the boundary at `point` against the chord with unit vectors `along`, `normal`.
double slope(const BoundaryPoint& point, const Vec2& along, const Vec2& normal) {
  const double cosine = point.normal.dot(normal);
  if (cosine < 0.5) return 0;  // a corner: the chord itself says more
  return -point.normal.dot(along) / cosine;
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
  const double u = std::clamp((place - from).dot(along) / length, 0.0, 1.0);
  const double bulge =
      length * u * (1 - u) *
      ((1 - u) * slope(first, along, normal) - u * slope(second, along, normal));
  const double growth = std::max(0.0, ahead);
  const double sigma = (1 - u) * (first.sigma + growth * first.sigma_growth) +
                       u * (second.sigma + growth * second.sigma_growth);
  return Beside{(place - from).dot(normal) - bulge, std::max(0.0, sigma), normal,
                (place - from - u * length * along).squaredNorm()};
}

// Is the crossing further from the believed boundary than two standard deviations?
std::optional<bool> is_outside(const Crossing& crossing,
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
  const double variance = nearest->sigma * nearest->sigma + across * across / 12 +
                          crossing.point_sd * crossing.point_sd;
  return nearest->off * nearest->off > 4 * variance;
}

}  // namespace

std::optional<ConfidenceMonitor::Verdict> ConfidenceMonitor::take(
    const Crossing& crossing, const BoundaryEstimate& before) {
  const auto outside = is_outside(crossing, before);
  if (!outside) return std::nullopt;
  outside_.push_back(*outside);
  if (outside_.size() > kRecent) outside_.pop_front();
  if (outside_.size() < kRecent) return std::nullopt;
  const double share = share_outside();
  if (over_confident_ ? share > kFewEnough : share < kTooMany) return std::nullopt;
  over_confident_ = !over_confident_;
  return over_confident_ ? Verdict::kOverConfident : Verdict::kTrustedAgain;
}

double ConfidenceMonitor::share_outside() const {
  if (outside_.empty()) return 0;
  const auto count = std::count(outside_.begin(), outside_.end(), true);
  return static_cast<double>(count) / static_cast<double>(outside_.size());
}

}  // namespace skein::monitoring
