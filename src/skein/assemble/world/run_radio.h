// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/assemble/kinds/contexts.h"
#include "skein/geo/vec.h"
#include "skein/simulation/world.h"

namespace skein::assemble {

/// What a radio is told of a world: who takes part, where they are, how they are turned
/// and what they are called, and its terrain. Seed, modem and kinds are left to the
/// caller. Refers to the world's parts, which outlive it wherever the world goes.
/// @param stations  places of the first entities, in N [m]
RadioContext radio_context(const simulation::World& world,
                           const std::vector<Vec3>& stations);

}  // namespace skein::assemble
