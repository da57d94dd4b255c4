// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/run_radio.h"

#include <optional>
#include <string>
#include <utility>

#include "skein/geo/rotation.h"
#include "skein/role/vehicle.h"

namespace skein::assemble {

RadioContext radio_context(const simulation::World& world,
                           const std::vector<Vec3>& stations) {
  std::vector<const Vehicle*> vehicles;
  std::vector<std::string> names;
  for (const simulation::Entity& entity : world.entities) {
    vehicles.push_back(entity.vehicle.get());
    names.push_back(entity.name);
  }
  RadioContext context;
  context.entities = world.entities.size();
  context.stations = stations.size();
  context.terrain = world.terrain.get();
  context.name = [names](EntityId id) { return names.at(id.value); };
  context.position = [vehicles, stations](EntityId id) -> std::optional<Vec3> {
    if (id.value < stations.size()) return stations[id.value];
    if (id.value >= vehicles.size() || !vehicles[id.value]) return std::nullopt;
    // Radio waves leave from where it is, known or not.
    const VehicleState* truth = vehicles[id.value]->truth();
    return truth ? truth->p_N : vehicles[id.value]->estimate().p_N;
  };
  context.attitude = [vehicles = std::move(vehicles)](EntityId id) -> Mat3 {
    if (id.value >= vehicles.size() || !vehicles[id.value]) return Mat3::Identity();
    if (const VehicleState* truth = vehicles[id.value]->truth())
      return truth->q_NB.toRotationMatrix();
    const NavEstimate& nav = vehicles[id.value]->estimate();
    return geo::from_euler({nav.roll, nav.pitch, nav.heading}).toRotationMatrix();
  };
  return context;
}

}  // namespace skein::assemble
