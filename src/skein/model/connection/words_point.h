// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/model/connection/words.h"

namespace skein::model::words {

/// A point to be met in some wind, in the reduced form of words.h.
struct PointProblem {
  Vec2 point = Vec2::Zero();  ///< at time 0
  Vec2 wind = Vec2::Zero();
  double wind2 = 0;  ///< squared, in (0, 1)

  /// The same for the turns exchanged.
  PointProblem mirrored() const;
};

/// Whether the point stays on the side of the positive turn, outside of its circle, until
/// `time`. Then nothing is quicker than that turn and a straight.
bool stays_outside(const PointProblem& p, double time);

/// Earliest meetings before `best`: a positive turn and a straight, a positive and a
/// negative turn. The first two parts count.
Meeting turn_straight(const PointProblem& p, double best);
Meeting turn_turn(const PointProblem& p, double best);

}  // namespace skein::model::words
