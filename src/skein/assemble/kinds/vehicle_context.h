// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "skein/assemble/kinds/contexts.h"
#include "skein/base/result.h"
#include "skein/mixed/recorded_port.h"
#include "skein/role/agent.h"
#include "skein/scenario/scenario.h"
#include "skein/simulation/simulated_vehicle.h"

namespace skein::vehicle_links {
class VehicleLinks;
}
namespace skein::modem {
class ModemLink;
}
namespace skein::world_link {
class EntityLinks;
}

namespace skein::assemble {

/// What every vehicle is given besides its options.
struct VehicleContext {
  const AircraftContext& aircraft;
  const scenario::Scenario& scenario;
  const scenario::AircraftGroup& group;
  int index = 0;  ///< in its group
  /// Name, plant, step, sensors, payload and where it starts; a vehicle takes what it is
  /// made of.
  simulation::VehicleParts& parts;
  /// Adds the rest of what a simulated vehicle is made of: autopilot, turbulence, faults.
  std::function<Result<void>()> complete;
  /// Adds the rest of what a body is made of: turbulence, faults.
  std::function<Result<void>()> complete_body;
  vehicle_links::VehicleLinks& links;  ///< of the run
  world_link::EntityLinks& remotes;    ///< of the run: to entities in other programs
  modem::ModemLink* modem = nullptr;   ///< of the run; null: there is none
  /// What stands here for an agent that is where its vehicle is; a vehicle whose agent is
  /// here leaves it null.
  std::unique_ptr<Agent>& agent;
  /// What a vehicle that is not simulated said, in a run that is done again; null: it is
  /// to speak for itself.
  const std::vector<mixed::TimedReport>* recorded = nullptr;
  /// Whether the scenario has a simulated aircraft of a name.
  std::function<bool(const std::string&)> is_simulated = {};
  /// An aircraft by its name, once all are made; before, and without one, null.
  std::function<const Vehicle*(const std::string&)> find = {};
};

}  // namespace skein::assemble
