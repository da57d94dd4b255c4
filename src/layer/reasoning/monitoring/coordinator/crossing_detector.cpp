#include "layer/reasoning/monitoring/coordinator/crossing_detector.h"

namespace skein::monitoring {

std::optional<Crossing> CrossingDetector::take(const FireReading& reading) {
  const auto [place, fresh] = last_.try_emplace(reading.aircraft, reading);
  if (fresh) return std::nullopt;
  const FireReading before = place->second;
  place->second = reading;
  const double gap = (reading.time - before.time).seconds();
  if (before.inside == reading.inside || gap > longest_gap_) return std::nullopt;
  Crossing crossing;
  crossing.time = reading.time;
  crossing.aircraft = reading.aircraft;
  crossing.point = (before.point + reading.point) / 2;
  crossing.track = reading.point - before.point;
  crossing.point_sd = reading.point_sd;
  crossing.entered = reading.inside;
  return crossing;
}

}  // namespace skein::monitoring
