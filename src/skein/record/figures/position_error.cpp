// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/position_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein::record {
namespace {

const Time kMemory = Time::from_seconds(10);  // older estimates are compared with nothing
const Time kMaxGap = Time::from_seconds(2);   // between truths that are joined

}  // namespace

void PositionError::truth(Time time, EntityId id, const Vec2& p, const Vec2& v) {
  std::deque<Place>& truths = tracks_[id].truths;
  if (!truths.empty() && time <= truths.back().time) truths.clear();
  truths.push_back({time, p, v});
  while (truths.size() > 2 && truths[1].time + kMemory < time) truths.pop_front();
}

std::optional<Vec2> PositionError::truth_at(const Track& track, Time time) const {
  const auto after = std::ranges::lower_bound(track.truths, time, {}, &Place::time);
  if (after == track.truths.end()) return std::nullopt;
  if (after->time == time) return after->p;
  if (after == track.truths.begin()) return std::nullopt;
  const Place &a = *(after - 1), &b = *after;
  if (b.time - a.time > kMaxGap) return std::nullopt;
  const double h = (b.time - a.time).seconds(), s = (time - a.time).seconds() / h;
  const double s2 = s * s, s3 = s2 * s;
  return Vec2((2 * s3 - 3 * s2 + 1) * a.p + (s3 - 2 * s2 + s) * h * a.v +
              (3 * s2 - 2 * s3) * b.p + (s3 - s2) * h * b.v);
}

void PositionError::estimate(Time time, EntityId id, const Vec2& p) {
  Track& track = tracks_[id];
  if (track.last && time <= *track.last) return;
  const bool is_first = !track.last;
  track.last = time;
  const auto there = truth_at(track, time);
  const std::optional<double> square =
      there ? std::optional((p - *there).squaredNorm()) : std::nullopt;
  if (is_first) {
    track.first = square;
    return;
  }
  for (const auto& each : {std::exchange(track.first, std::nullopt), square}) {
    if (!each) continue;
    sum_ += *each;
    count_ += 1;
  }
}

std::optional<double> PositionError::rms() const {
  if (count_ == 0) return std::nullopt;
  return std::sqrt(sum_ / count_);
}

}  // namespace skein::record
