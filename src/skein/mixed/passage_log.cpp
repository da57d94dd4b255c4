// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/passage_log.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::mixed {
namespace {

constexpr Time kPointPeriod = Time::from_ns(500'000'000);
// Points further apart in time are not joined: it was away between them.
constexpr Time kMaxGap = Time::from_ns(1'500'000'000);

// Where on the way from a to b, from 0 to 1, it is nearest. The distance to a convex body
// is convex along a line: the search in thirds finds its minimum.
double nearest_share(const Cylinder& body, const Vec3& a, const Vec3& b) {
  const auto distance = [&](double share) { return body.distance(a + share * (b - a)); };
  double low = 0, high = 1;
  for (int k = 0; k < 30; ++k) {
    const double left = low + (high - low) / 3, right = high - (high - low) / 3;
    if (distance(left) <= distance(right))
      high = right;
    else
      low = left;
  }
  return (low + high) / 2;
}

}  // namespace

double Cylinder::distance(const Vec3& p_N) const {
  const double aside = std::max(0.0, (geo::horizontal(p_N) - centre).norm() - radius);
  const double altitude = -p_N.z();
  const double above = std::max({0.0, altitude - top_msl, bottom_msl - altitude});
  return math::hypot(aside, above);
}

void PassageLog::add(Time time, EntityId aircraft, const Vec3& p_N) {
  std::deque<Point>& track = tracks_[aircraft];
  if (!track.empty() && time - track.back().time < kPointPeriod) return;
  track.push_back({time, p_N});
  if (track.size() > kMaxPoints) track.pop_front();
}

std::vector<Passage> PassageLog::nearest(const Cylinder& body, Time from, Time until,
                                         double within) const {
  std::vector<Passage> all;
  for (const auto& [aircraft, track] : tracks_) {
    std::optional<Passage> nearest;
    auto point = std::lower_bound(track.begin(), track.end(), from,
                                  [](const Point& p, Time t) { return p.time < t; });
    for (; point != track.end() && point->time <= until; ++point) {
      Time time = point->time;
      double distance = body.distance(point->p_N);
      if (point != track.begin()) {
        const Point& before = *std::prev(point);
        const double length = (point->p_N - before.p_N).norm();
        if (before.time >= from && point->time - before.time <= kMaxGap &&
            distance - length < within) {
          const double share = nearest_share(body, before.p_N, point->p_N);
          distance = body.distance(before.p_N + share * (point->p_N - before.p_N));
          time = before.time +
                 Time::from_seconds(share * (point->time - before.time).seconds());
        }
      }
      if (distance <= within && (!nearest || distance < nearest->distance))
        nearest = {aircraft, time, distance};
    }
    if (nearest) all.push_back(*nearest);
  }
  return all;
}

}  // namespace skein::mixed
