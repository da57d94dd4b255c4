// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "skein/assemble/kinds/contexts.h"
#include "skein/assemble/kinds/vehicle_faults.h"
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
  const Parts& mounted;                ///< what stands in `parts`, by kinds
  const KindsByRole& kinds;            ///< of its parts
  vehicle_links::VehicleLinks& links;  ///< of the run
  world_link::EntityLinks& remotes;    ///< of the run: to entities in other programs
  modem::ModemLink* modem = nullptr;   ///< of the run; null: there is none
  /// What stands here for an agent that is where its vehicle is; a vehicle whose agent is
  /// here leaves it null.
  std::unique_ptr<Agent>& agent;
  /// What a vehicle that is not simulated said, in a run that is done again; null: it is
  /// to speak for itself.
  const std::vector<mixed::TimedReport>* recorded = nullptr;
  const std::set<std::string>& simulated;  ///< names of all such aircraft of the scenario
  /// All aircraft by their names, each from when it is made on.
  std::shared_ptr<const std::map<std::string, const Vehicle*>> vehicles;
};

/// Adds the autopilot to the parts, for a vehicle that has its own here. Fails: what it
/// cannot be made from.
Result<void> add_autopilot(const VehicleContext& context);

/// Adds what a body that is here has besides its plant: the gusts that it flies in,
/// faults that are going to happen, parts that a command can make fail. Fails: what these
/// cannot be made from.
Result<void> add_body(const VehicleContext& context);

}  // namespace skein::assemble
