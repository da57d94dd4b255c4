// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/target/moving_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/solve/path/limits_check.h"

namespace skein::solve {
namespace {

constexpr double kMaxSpeed = 1e4;  // [m/s]

// The part of the track that counts at a time: from point k to k + 1.
std::size_t part_at(const MovingTarget& target, double time) {
  const auto& track = target.track;
  std::size_t k = 0;
  while (k + 2 < track.size() && time >= track[k + 1].time) ++k;
  return k;
}

bool moves_evenly(const MovingTarget& target) {
  return target.track.empty();
}

}  // namespace

std::string error_of(const MovingTarget& target) {
  if (moves_evenly(target)) {
    const bool fine = usable_time(target.at.time) && on_map(target.at.position) &&
                      target.velocity.norm() <= kMaxSpeed;
    return fine ? "" : "the target's time, place or velocity is not a usable number";
  }
  const auto& track = target.track;
  if (track.size() < 2) return "a track has two points or more";
  for (std::size_t k = 0; k < track.size(); ++k) {
    if (!usable_time(track[k].time) || !on_map(track[k].position))
      return fmt::format("point {} of the track is not a place at a time", k);
    if (k > 0 && !(track[k].time - track[k - 1].time > 1e-3))
      return fmt::format("point {} of the track is not later than the one before", k);
  }
  return {};
}

Vec2 position_at(const MovingTarget& target, double time) {
  if (moves_evenly(target))
    return target.at.position + (time - target.at.time) * target.velocity;
  const TimedPosition& from = target.track[part_at(target, time)];
  return from.position + (time - from.time) * velocity_at(target, time);
}

Vec2 velocity_at(const MovingTarget& target, double time) {
  if (moves_evenly(target)) return target.velocity;
  const std::size_t k = part_at(target, time);
  const TimedPosition& a = target.track[k];
  const TimedPosition& b = target.track[k + 1];
  return (b.position - a.position) / (b.time - a.time);
}

double next_change(const MovingTarget& target, double time) {
  for (std::size_t k = 1; k + 1 < target.track.size(); ++k)
    if (target.track[k].time > time) return target.track[k].time;
  return std::numeric_limits<double>::infinity();
}

double strongest_wind(const MovingTarget& target, const Vec2& wind, double time) {
  double strongest = (wind - velocity_at(target, time)).norm();
  for (double t = next_change(target, time); std::isfinite(t); t = next_change(target, t))
    strongest = std::max(strongest, (wind - velocity_at(target, t)).norm());
  return strongest;
}

}  // namespace skein::solve
