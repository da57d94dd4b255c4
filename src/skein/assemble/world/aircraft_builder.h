// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "skein/assemble/kinds/contexts.h"
#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/kinds/vehicle_faults.h"
#include "skein/base/result.h"
#include "skein/data/airspace/zone.h"
#include "skein/mixed/recorded_port.h"
#include "skein/role/path_planner.h"
#include "skein/role/plant.h"
#include "skein/role/wind_field.h"
#include "skein/scenario/scenario.h"
#include "skein/simulation/simulated_vehicle.h"
#include "skein/simulation/world.h"

namespace skein::vehicle_links {
class VehicleLinks;
}
namespace skein::modem {
class ModemLink;
}
namespace skein::world_link {
class EntityLinks;
class WorldClient;
}  // namespace skein::world_link

namespace skein::assemble {

/// What vehicles that are not simulated said in a run that is done again.
using RecordedReports = std::map<EntityId, std::vector<mixed::TimedReport>>;

/// What the aircraft of a scenario are called, group by group: GROUP-1, GROUP-2...
std::vector<std::vector<std::string>> aircraft_names(const scenario::Scenario& scenario);

/// What joins aircraft to others outside of this program. All outlive what is made.
struct OutsideLinks {
  vehicle_links::VehicleLinks& vehicles;  ///< real ones
  world_link::EntityLinks& entities;      ///< in other programs
  /// The world that the aircraft of this program takes part in; null: it is this one.
  world_link::WorldClient* world = nullptr;
  modem::ModemLink* modem = nullptr;  ///< of the radio; null: there is none
};

/// Makes the aircraft of a scenario, one after the other. Those of one group share their
/// plant, unless each differs a little.
class AircraftBuilder {
 public:
  /// All references outlive the builder.
  /// @param recorded  null: vehicles that are not simulated speak for themselves.
  AircraftBuilder(const scenario::Scenario& scenario, const KindsByRole& kinds,
                  std::shared_ptr<const Terrain> map, const std::vector<Zone>& zones,
                  const WindField& wind, const OutsideLinks& links,
                  RecordedReports* recorded);

  /// Aircraft `index` of `group`, which becomes entity `self` and reports to `station`.
  /// Fails: what a part cannot be made from; a start inside terrain or a no-fly zone;
  ///        parts that do not fit together, or that cannot fail because they are not
  ///        there.
  Result<simulation::Entity> make(const scenario::AircraftGroup& group, int index,
                                  EntityId self, EntityId station);

  /// Whether one that was made has a sensor for other aircraft.
  bool finds_aircraft() const { return finds_aircraft_; }

  /// The last that was made, as missions choose theirs.
  const TeamAircraft& last() const { return last_; }

 private:
  // A vehicle, and what stands here for its agent where that is elsewhere; else null.
  struct Flown {
    std::unique_ptr<Vehicle> vehicle;
    std::unique_ptr<Agent> agent;
  };

  // What is known before a part is made.
  AircraftContext context_of(const scenario::AircraftGroup& group, int index,
                             EntityId self, EntityId station);
  Result<void> add_plant(const scenario::AircraftGroup& group, AircraftContext& context,
                         simulation::VehicleParts& vehicle);
  Result<Flown> make_vehicle(const scenario::AircraftGroup& group, int index,
                             const AircraftContext& context, const Parts& mounted,
                             simulation::VehicleParts& vehicle);
  // What an autopilot and planners know: the plant as its group has it.
  Result<std::shared_ptr<const Plant>> nominal_plant(const scenario::AircraftGroup& group,
                                                     const AircraftContext& context);
  Result<void> put(const std::string& name, const scenario::AircraftGroup& group,
                   int index, simulation::VehicleParts& vehicle) const;
  Result<Parts> mount_sensors(const scenario::AircraftGroup& group,
                              AircraftContext& context,
                              simulation::VehicleParts& vehicle) const;
  std::vector<EntityId> watchers(const scenario::AircraftGroup& group, EntityId self);
  bool finds_aircraft(const scenario::AircraftGroup& group);

  const scenario::Scenario& scenario_;
  const KindsByRole& kinds_;
  std::shared_ptr<const TaskKinds> tasks_;
  std::shared_ptr<const Terrain> map_;
  const std::vector<Zone>& zones_;
  const WindField& wind_;
  OutsideLinks links_;
  RecordedReports* recorded_;
  std::shared_ptr<const PathPlanner> planner_;
  std::map<const scenario::AircraftGroup*, std::shared_ptr<const Plant>> plants_;
  std::map<const scenario::AircraftGroup*, std::any> shared_;  // of their autopilots
  std::vector<std::vector<std::string>> names_;                // of each group
  std::set<std::string> simulated_;                            // names of those
  double place_period_;
  // All that were made, for those who look at others when the run goes.
  std::shared_ptr<std::map<std::string, const Vehicle*>> made_ =
      std::make_shared<std::map<std::string, const Vehicle*>>();
  std::map<const scenario::AircraftGroup*, bool> finds_;  // other aircraft
  bool finds_aircraft_ = false;
  TeamAircraft last_;
};

}  // namespace skein::assemble
