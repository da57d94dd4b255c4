// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/scenario/scenario.h"

namespace skein::assemble {

/// Where an aircraft stands at the start.
struct Place {
  Vec2 position = Vec2::Zero();  ///< [m]
  double heading = 0;            ///< [rad]
};

/// Place of aircraft `index` of `count` in its group. Reference: docs/scenario-keys.md.
Place place_at_start(const scenario::Start& start, int index, int count);

}  // namespace skein::assemble
