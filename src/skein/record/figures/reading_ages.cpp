// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/reading_ages.h"

#include <algorithm>
#include <utility>

namespace skein::record {
namespace {

constexpr double kReach = 100;       // a crossing informs about this much boundary [m]
constexpr double kSpacing = 25;      // of the markers, unless they get too many [m]
constexpr double kMaxMarkers = 200;  // about
constexpr double kSameFront = 300;   // no front moves further between two calls [m]

double square(double x) {
  return x * x;
}

}  // namespace

void ReadingAges::move_markers(const TrueBoundary& truth, double spacing) {
  std::vector<Marker> moved;
  for (const Marker& marker : markers_) {
    const geo::NearestPoint nearest = truth.index().nearest(marker.point);
    if (nearest.distance > kSameFront) continue;  // its part of the front has gone
    const bool crowded =
        std::any_of(moved.begin(), moved.end(), [&](const Marker& other) {
          return (other.point - nearest.point).squaredNorm() < square(spacing / 3);
        });
    if (!crowded) moved.push_back({marker.crossed, nearest.point});
  }
  markers_ = std::move(moved);
}

void ReadingAges::fill_gaps(const TrueBoundary& truth, double spacing) {
  const std::size_t old = markers_.size();
  for (const geo::Ring& ring : truth.region()) {
    if (ring.size() < 3) continue;
    for (const Vec2& point : geo::resample_by_spacing(ring, spacing)) {
      double nearest = square(kSameFront);
      Time crossed;
      for (std::size_t i = 0; i < old; ++i) {
        const double distance = (markers_[i].point - point).squaredNorm();
        if (distance < nearest) {
          nearest = distance;
          crossed = markers_[i].crossed;
        }
      }
      if (nearest > square(0.8 * spacing)) markers_.push_back({crossed, point});
    }
  }
}

void ReadingAges::apply_crossings(const TrueBoundary& truth, double spacing) {
  const double reach = std::max(kReach, spacing);
  for (const Marker& crossing : crossings_) {
    const Vec2 place = truth.index().nearest(crossing.point).point;
    for (Marker& marker : markers_)
      if ((marker.point - place).squaredNorm() <= square(reach))
        marker.crossed = std::max(marker.crossed, crossing.crossed);
  }
  crossings_.clear();
}

std::optional<ReadingAges::Ages> ReadingAges::ages(Time now, const TrueBoundary& truth,
                                                   const BoundaryEstimate& belief) {
  if (truth.index().empty()) return std::nullopt;
  const double spacing = std::max(kSpacing, geo::length(truth.region()) / kMaxMarkers);
  move_markers(truth, spacing);
  fill_gaps(truth, spacing);
  apply_crossings(truth, spacing);
  if (markers_.empty()) return std::nullopt;

  Ages ages;
  double count = 0;
  for (const auto& ring : belief.rings)
    for (const BoundaryPoint& point : ring) {
      const Vec2 place = truth.index().nearest(point.position).point;
      const auto nearest = std::min_element(
          markers_.begin(), markers_.end(), [&](const Marker& a, const Marker& b) {
            return (a.point - place).squaredNorm() < (b.point - place).squaredNorm();
          });
      const double age = (now - nearest->crossed).seconds();
      ages.mean += age;
      ages.max = std::max(ages.max, age);
      count += 1;
    }
  if (count == 0) return std::nullopt;
  ages.mean /= count;
  return ages;
}

}  // namespace skein::record
