// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/scenario/scenario.h"
#include "skein/simulation/world.h"

namespace skein::assemble {

/// When aircraft `index` of a group takes part: from joining to leaving, back from
/// returning, without the times in which it has failed.
std::vector<simulation::ActiveSpan> presence(const scenario::AircraftGroup& group,
                                             int index, Time duration);

}  // namespace skein::assemble
