// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/perimeter/observation.h"
#include "skein/data/traffic/traffic.h"

namespace skein {
class Agent;
class MovingObject;
class Phenomenon;
class Radio;
class Terrain;
class TrafficAircraft;
class Vehicle;
class WorldMemory;
}  // namespace skein

namespace skein::simulation {

class CommandedWind;

/// A span of time in which an entity takes part; `until` is exclusive.
struct ActiveSpan {
  Time from;
  Time until;
};

/// An aircraft or a ground station: an agent and, for an aircraft, what it flies with.
struct Entity {
  Entity();
  Entity(Entity&&) noexcept;
  Entity& operator=(Entity&&) noexcept;
  ~Entity();

  std::string name;
  std::string kind;  ///< "aircraft" or "station"
  /// Which objects its sensors see, and how.
  EntityReality reality = entity_reality(Reality::kVirtual, Reality::kVirtual);
  Transmitters sends;                ///< by which other aircraft may notice it
  std::uint32_t address = 0;         ///< that it sends with them
  std::unique_ptr<Agent> agent;      ///< never null
  std::unique_ptr<Vehicle> vehicle;  ///< null for a station
  Time agent_period;                 ///< a multiple of the step
  std::vector<ActiveSpan> active;    ///< in order of time; empty = never takes part
};

/// A thing on the ground.
struct WorldObject {
  WorldObject(GroundObject object, std::unique_ptr<MovingObject> movement);
  WorldObject(WorldObject&&) noexcept;
  WorldObject& operator=(WorldObject&&) noexcept;
  ~WorldObject();

  GroundObject object;
  std::unique_ptr<MovingObject> movement;  ///< never null
  std::optional<PhysicalObject> body;      ///< of one that exists in reality
};

/// An aircraft that belongs to nobody who takes part.
struct WorldTraffic {
  WorldTraffic(AirTraffic what, std::unique_ptr<TrafficAircraft> aircraft);
  WorldTraffic(WorldTraffic&&) noexcept;
  WorldTraffic& operator=(WorldTraffic&&) noexcept;
  ~WorldTraffic();

  AirTraffic what;
  std::unique_ptr<TrafficAircraft> aircraft;  ///< never null
  Time from, until;                           ///< it is there; `until` is exclusive
};

/// Everything that exists in a run. Entity k has EntityId k.
struct World {
  World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  std::unique_ptr<Terrain> terrain;
  std::unique_ptr<CommandedWind> wind;
  std::vector<std::unique_ptr<Phenomenon>> phenomena;
  std::unique_ptr<Radio> radio;
  std::vector<Entity> entities;
  std::vector<WorldObject> objects;
  std::vector<WorldTraffic> traffic;
  bool finds_aircraft = false;  ///< somebody has a sensor for other aircraft
  /// What is known of the physical ones; null where there are none.
  std::unique_ptr<WorldMemory> memory;
  std::vector<Zone> zones;  ///< in force from the start; for the records
};

}  // namespace skein::simulation
