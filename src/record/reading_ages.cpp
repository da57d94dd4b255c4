#include "record/reading_ages.h"

#include <algorithm>

namespace skein::record {
namespace {

constexpr double kReach = 100;         // a crossing tells about this much boundary [m]
constexpr double kMarkerSpacing = 20;  // a newer marker replaces older ones this near [m]

}  // namespace

std::optional<Crossing> ReadingAges::add(const FireReading& reading) {
  const auto [place, first] = last_.try_emplace(reading.aircraft, reading);
  if (first) return std::nullopt;
  const FireReading before = place->second;
  if (reading.time <= before.time) return std::nullopt;  // arrived late or twice
  place->second = reading;
  if (reading.inside == before.inside) return std::nullopt;

  Crossing crossing;
  crossing.time = reading.time;
  crossing.aircraft = reading.aircraft;
  crossing.point = (before.point + reading.point) / 2;
  crossing.track = reading.point - before.point;
  crossing.point_sd = reading.point_sd;
  crossing.entered = reading.inside;

  std::erase_if(markers_, [&](const Marker& marker) {
    return (marker.point - crossing.point).squaredNorm() <
           kMarkerSpacing * kMarkerSpacing;
  });
  markers_.push_back({crossing.time, crossing.point});
  return crossing;
}

std::optional<ReadingAges::Ages> ReadingAges::ages(Time now,
                                                   const geo::BoundaryIndex& truth,
                                                   const BoundaryEstimate& belief) {
  if (truth.empty()) return std::nullopt;
  for (Marker& marker : markers_) marker.point = truth.nearest(marker.point).point;

  Ages ages;
  double count = 0;
  for (const auto& ring : belief.rings)
    for (const BoundaryPoint& point : ring) {
      const Vec2 place = truth.nearest(point.position).point;
      const auto near =
          std::find_if(markers_.rbegin(), markers_.rend(), [&](const Marker& marker) {
            return (marker.point - place).squaredNorm() <= kReach * kReach;
          });
      const double age = (near == markers_.rend() ? now : now - near->time).seconds();
      ages.mean += age;
      ages.max = std::max(ages.max, age);
      count += 1;
    }
  if (count == 0) return std::nullopt;
  ages.mean /= count;
  return ages;
}

}  // namespace skein::record
