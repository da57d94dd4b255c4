// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein {

/// What a thing on the ground may notice.
struct ObjectView {
  Time now;
  /// True places of all aircraft that take part, in N [m].
  std::span<const Vec3> aircraft = {};
};

/// How one thing on the ground moves.
class MovingObject {
 public:
  virtual ~MovingObject() = default;

  /// Moves to `view.now`, which never goes back. Called for time 0 first, then once in
  /// each step of the run.
  virtual void advance(const ObjectView& view) = 0;

  /// Where it is at the time of the last advance() [m].
  virtual Vec2 position() const = 0;

  /// How it moves from then on, over ground [m/s].
  virtual Vec2 velocity() const = 0;
};

}  // namespace skein
