// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/base/result.h"
#include "skein/scenario/scenario.h"
#include "skein/simulation/world.h"

namespace skein::assemble {

/// Makes the other air traffic of a scenario.
/// @param entities  of the world, for those who follow one of them.
/// @param warnings  what recorded flights have that nobody flies is added.
/// Fails: what a flight cannot be made from; an address for several aircraft.
Result<std::vector<simulation::WorldTraffic>> make_traffic(
    const scenario::Scenario& scenario, const KindsByRole& kinds,
    const geo::LocalFrame& frame, std::span<const simulation::Entity> entities,
    std::vector<std::string>& warnings);

}  // namespace skein::assemble
