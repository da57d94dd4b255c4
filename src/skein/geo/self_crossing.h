// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "skein/geo/vec.h"

namespace skein::geo {

/// Where two edges of a ring cross: those that begin at its points `first` and `second`.
struct SelfCrossing {
  Vec2 point = Vec2::Zero();
  std::size_t first = 0, second = 0;
};

/// The first place where a ring (see geo/polygon.h) crosses itself; none when it does
/// not. Edges that only touch do not cross. Cost: quadratic in the points.
std::optional<SelfCrossing> self_crossing(std::span<const Vec2> ring);

}  // namespace skein::geo
