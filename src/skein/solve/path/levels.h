// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/solve/path/airspace_map.h"

namespace skein::solve {

/// Altitudes [m] at which a flight between the query's start and goal might pass: just
/// over and under the zones that end in altitude, and over the ground that lies on the
/// straight line. The nearest to the start and the goal first, six at most.
std::vector<double> levels_between(const AirspaceMap& map);

}  // namespace skein::solve
