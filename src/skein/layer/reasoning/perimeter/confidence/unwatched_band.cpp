// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/confidence/unwatched_band.h"

#include <algorithm>
#include <cmath>

namespace skein::perimeter {
namespace {

constexpr double kUnwatched = 300;  // not seen for this long, a part is unwatched [s]
constexpr double kRound = 200;      // in which what is seen of a place is one look [s]
constexpr double kEvery = 100;      // a forecast is kept [s]
constexpr double kNear = 300;       // a crossing shows the boundary around it [m]
// Gains towards larger and smaller errors: the expectile of level 0.05/(0.05 + 0.02).
constexpr double kGainUp = 0.05, kGainDown = 0.02;
constexpr double kConsistentSquare =
    1.6;  // what it is for squared standard normal numbers

}  // namespace

bool UnwatchedBand::due(Time now) const {
  return forecasts_.empty() || (now - forecasts_.back().time).seconds() >= kEvery;
}

void UnwatchedBand::keep(BoundaryEstimate forecast) {
  const Time now = forecast.time;
  forecasts_.push_back(std::move(forecast));
  while (forecasts_.size() > 1 && (now - forecasts_[1].time).seconds() >= kRound)
    forecasts_.pop_front();
}

void UnwatchedBand::see(const Crossing& crossing) {
  if (!forecasts_.empty()) {
    const BoundaryEstimate& before = forecasts_.front();
    const bool a_round_ago = (crossing.time - before.time).seconds() >= kRound;
    const Time from = before.time - Time::from_seconds(kUnwatched);
    if (a_round_ago && from >= Time() && !seen(crossing.point, from, before.time))
      if (const auto offset = crossing_offset(crossing, before)) {
        const double change = offset->square() - square_;
        square_ += (change > 0 ? kGainUp : kGainDown) * change;
      }
  }
  sights_.push_back({crossing.time, crossing.point});
  const double memory = kUnwatched + kRound + kEvery;
  while ((crossing.time - sights_.front().time).seconds() > memory) sights_.pop_front();
}

bool UnwatchedBand::seen(const Vec2& place, Time from, Time until) const {
  return std::any_of(sights_.begin(), sights_.end(), [&](const Sight& s) {
    return s.time >= from && s.time <= until &&
           (s.place - place).squaredNorm() < kNear * kNear;
  });
}

double UnwatchedBand::factor() const {
  return std::sqrt(std::max(1.0, square_ / kConsistentSquare));
}

void UnwatchedBand::widen(BoundaryEstimate& boundary) const {
  const double widening = factor();
  if (widening <= 1) return;
  const Time from = boundary.time - Time::from_seconds(kUnwatched);
  for (auto& ring : boundary.rings)
    for (BoundaryPoint& point : ring) {
      if (seen(point.position, from, boundary.time)) continue;
      point.sigma *= widening;
      point.sigma_growth *= widening;
    }
}

}  // namespace skein::perimeter
