// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/geo/vec.h"

namespace skein::solve {

/// Where something is at a time.
struct TimedPosition {
  double time = 0;               ///< [s]
  Vec2 position = Vec2::Zero();  ///< [m]
};

/// Something on the ground or in the air that is flown around or followed: it moves
/// evenly, or evenly from point to point of a track, and goes on as on the last part of
/// it.
struct MovingTarget {
  TimedPosition at;                       ///< without a track: where it is at a time...
  Vec2 velocity = Vec2::Zero();           ///< ...and how it moves [m/s]
  std::vector<TimedPosition> track = {};  ///< two points or more, with growing times
};

/// What is wrong with a target; empty when nothing is.
std::string error_of(const MovingTarget& target);

Vec2 position_at(const MovingTarget& target, double time);  ///< [m]
/// [m/s]; at a corner of the track that after it.
Vec2 velocity_at(const MovingTarget& target, double time);

/// The next time after `time` at which its velocity changes; infinite when it never does.
double next_change(const MovingTarget& target, double time);

/// The strongest wind that somebody who moves with the target feels from `time` on [m/s].
double strongest_wind(const MovingTarget& target, const Vec2& wind, double time);

}  // namespace skein::solve
