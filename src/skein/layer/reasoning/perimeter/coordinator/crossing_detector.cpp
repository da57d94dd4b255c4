// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/crossing_detector.h"

#include <algorithm>
#include <utility>

namespace skein::perimeter {

std::optional<Crossing> CrossingDetector::take(const HeardReading& heard) {
  constexpr double kSlowest = 30;   // period of a sensor whose readings still pair [s]
  constexpr double kPairGap = 1.5;  // of that period, between readings that pair
  if (heard.follows == Follows::kNothing) return std::nullopt;
  const FireReading& reading = heard.reading;
  const auto [place, fresh] = last_.try_emplace(reading.aircraft, Last{reading});
  if (fresh) return std::nullopt;
  Last& last = place->second;
  const FireReading before = std::exchange(last.reading, reading);
  const double gap = (reading.time - before.time).seconds();
  const bool shows_period = heard.follows != Follows::kPerhaps;
  if (shows_period && gap > 0 && (last.min_interval == 0 || gap < last.min_interval))
    last.min_interval = gap;
  const double longest =
      std::max(longest_gap_, kPairGap * std::min(last.min_interval, kSlowest));
  if (before.inside == reading.inside || gap > longest) return std::nullopt;
  Crossing crossing;
  crossing.time = reading.time;
  crossing.aircraft = reading.aircraft;
  crossing.point = (before.point + reading.point) / 2;
  crossing.track = reading.point - before.point;
  crossing.point_sd = reading.point_sd;
  crossing.entered = reading.inside;
  return crossing;
}

}  // namespace skein::perimeter
