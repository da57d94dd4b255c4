// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "skein/base/time.h"
#include "skein/geo/polygon.h"

namespace skein {

/// A growing area with a sharp boundary: a true fire.
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

/// The phenomena of a world, in the order of the scenario.
using Phenomena = std::span<const Phenomenon* const>;

/// Whether `p` is inside any of them, or inside one.
/// @param which  its place in the list; none: any. Nothing is inside one that is missing.
inline bool inside(Phenomena all, std::optional<std::uint32_t> which, const Vec2& p) {
  if (which) return *which < all.size() && all[*which]->inside(p);
  return std::any_of(all.begin(), all.end(),
                     [&](const Phenomenon* each) { return each->inside(p); });
}

}  // namespace skein
