#pragma once

#include "skein/base/time.h"
#include "skein/geo/polygon.h"

namespace skein {

/// A growing area with a sharp boundary: the true fire.
class Phenomenon {
 public:
  virtual ~Phenomenon() = default;

  /// Moves to `time`, which never goes back.
  virtual void advance(Time time) = 0;

  /// Whether `p` burns or has burnt, at the time of the last advance(). Any thread may
  /// ask between advances.
  virtual bool inside(const Vec2& p) const = 0;

  /// The burnt region at the time of the last advance().
  virtual const geo::Region& region() const = 0;
};

}  // namespace skein
