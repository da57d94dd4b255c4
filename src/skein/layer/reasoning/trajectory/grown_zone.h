// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/airspace/zone.h"

namespace skein::reasoning {

/// A zone with a margin around it, above and below. What it surrounds closely is filled:
/// planners want rings without holes.
/// @param margin    sideways [m]; not above 0: none.
/// @param vertical  above and below [m].
Zone grown(Zone zone, double margin, double vertical);

}  // namespace skein::reasoning
