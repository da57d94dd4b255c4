// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "skein/data/perimeter/observation.h"
#include "skein/role/terrain.h"
#include "skein/role/world_memory.h"
#include "skein/scenario/scenario.h"
#include "skein/simulation/world.h"

namespace skein::assemble {

/// Where the aircraft of a group stand between the physical and the virtual.
EntityReality reality_of(const scenario::AircraftGroup& group);

/// The body of an object that exists in reality.
PhysicalObject body_of(const scenario::PlacedObject& object, std::uint32_t id);

/// What the server knows of the physical objects of a world; null where there are none.
/// @param map  that objects stand on.
std::unique_ptr<WorldMemory> server_memory(const scenario::ServerMemory& described,
                                           const simulation::World& world,
                                           std::shared_ptr<const Terrain> map);

/// What physical objects of a scenario are in vain, one line each.
std::vector<std::string> memory_warnings(const scenario::Scenario& scenario);

}  // namespace skein::assemble
