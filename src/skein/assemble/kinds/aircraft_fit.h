// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/base/result.h"
#include "skein/scenario/scenario.h"
#include "skein/simulation/world.h"

namespace skein::assemble {

/// Index of the ground station that a group belongs to.
std::size_t station_of(const scenario::Scenario& scenario,
                       const scenario::AircraftGroup& group);

/// Between a station's heartbeats, as the scenario says or as autopilots need; 0 = none.
Time heartbeat(const scenario::Scenario& scenario, const scenario::Station& station);

/// What of a ready aircraft does not go together, all of it: an altitude where the air
/// does not carry it, sensors that its autopilot cannot fly by, gains for another
/// airframe, failsafes that would act at once for ever, a fence that it starts outside
/// of.
///
/// @param kinds     that the scenario was read with. Sensors of plugins may serve any
///                  autopilot: what they measure is not known here.
/// @param group     it is one of.
/// @param aircraft  as it starts.
std::vector<Error> incompatibilities(const scenario::Scenario& scenario,
                                     const KindRegistry& kinds,
                                     const scenario::AircraftGroup& group,
                                     const simulation::Entity& aircraft);

/// What will hardly fly well, in one line each.
std::vector<std::string> warnings(const scenario::Scenario& scenario,
                                  const scenario::AircraftGroup& group,
                                  const simulation::Entity& aircraft);

}  // namespace skein::assemble
