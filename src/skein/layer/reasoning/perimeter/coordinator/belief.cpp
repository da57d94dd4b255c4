// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/belief.h"

#include <algorithm>
#include <tuple>

namespace skein::perimeter {
namespace {

bool earlier(const HeardReading& one, const HeardReading& other) {
  const FireReading &a = one.reading, &b = other.reading;
  return std::tie(a.time, a.aircraft) < std::tie(b.time, b.aircraft);
}

}  // namespace

Belief::Belief(std::unique_ptr<PerimeterEstimator> estimator, double window)
    : window_(window), now_{Time::from_ns(-1), std::move(estimator), CrossingDetector()} {
  checkpoints_.push_back(now_.copy());
}

std::vector<Crossing> Belief::use(const HeardReading& heard) {
  const FireReading& reading = heard.reading;
  boundary_.reset();
  now_.estimator->predict(reading.time);
  now_.time = reading.time;
  std::vector<Crossing> crossings;
  if (const auto crossing = now_.detector.take(heard)) {
    now_.estimator->observe(*crossing);
    crossings.push_back(*crossing);
  } else {
    now_.estimator->observe(reading);
  }
  return crossings;
}

std::vector<Crossing> Belief::take(std::vector<HeardReading> readings) {
  std::vector<Crossing> crossings;
  if (readings.empty()) return crossings;
  std::stable_sort(readings.begin(), readings.end(), earlier);
  const Time oldest = checkpoints_.front().time;
  const auto kept =
      std::find_if(readings.begin(), readings.end(),
                   [&](const HeardReading& r) { return r.reading.time > oldest; });
  dropped_ += static_cast<int>(kept - readings.begin());
  readings.erase(readings.begin(), kept);
  if (readings.empty()) return crossings;

  std::vector<HeardReading> to_use = readings;
  const Time first = readings.front().reading.time;
  if (first < now_.time) {
    // Go back to the last checkpoint before the earliest late reading.
    while (checkpoints_.size() > 1 && checkpoints_.back().time >= first)
      checkpoints_.pop_back();
    now_ = checkpoints_.back().copy();
    boundary_.reset();
    const auto since = std::find_if(history_.begin(), history_.end(), [&](const auto& r) {
      return r.reading.time > now_.time;
    });
    to_use.clear();
    std::merge(since, history_.end(), readings.begin(), readings.end(),
               std::back_inserter(to_use), earlier);
    history_.erase(since, history_.end());
  }
  for (const HeardReading& heard : to_use) {
    const FireReading& reading = heard.reading;
    const bool fresh = std::any_of(readings.begin(), readings.end(), [&](const auto& r) {
      return r.reading.time == reading.time && r.reading.aircraft == reading.aircraft;
    });
    if (reading.time > now_.time) keep_checkpoint();
    for (const Crossing& crossing : use(heard))
      if (fresh) crossings.push_back(crossing);
    history_.push_back(heard);
  }
  return crossings;
}

void Belief::keep_checkpoint() {
  constexpr double kSpacing = 10;  // [s]: replays stay short, copies rare
  if ((now_.time - checkpoints_.back().time).seconds() < kSpacing) return;
  checkpoints_.push_back(now_.copy());
  while (checkpoints_.size() > 1 &&
         (now_.time - checkpoints_[1].time).seconds() >= window_)
    checkpoints_.pop_front();
  std::erase_if(history_, [&](const HeardReading& r) {
    return r.reading.time <= checkpoints_.front().time;
  });
}

void Belief::predict(Time time) {
  if (time <= now_.time) return;
  boundary_.reset();
  now_.estimator->predict(time);
  now_.time = time;
}

BoundaryEstimate Belief::boundary_at(Time now) {
  if (!boundary_) boundary_ = now_.estimator->boundary();
  BoundaryEstimate boundary = *boundary_;
  const double ahead = (now - boundary.time).seconds();
  boundary.time = now;
  for (auto& ring : boundary.rings)
    for (BoundaryPoint& point : ring) {
      point.position += ahead * point.rate * point.normal;
      point.sigma += ahead * point.sigma_growth;
    }
  return boundary;
}

}  // namespace skein::perimeter
