#pragma once

#include <memory>
#include <string>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/air.h"
#include "skein/data/fault.h"
#include "skein/data/object.h"
#include "skein/data/vehicle.h"
#include "skein/data/zone.h"
#include "skein/role/agent.h"
#include "skein/role/autopilot.h"
#include "skein/role/phenomenon.h"
#include "skein/role/plant.h"
#include "skein/role/radio.h"
#include "skein/role/sensor.h"
#include "skein/role/terrain.h"
#include "skein/role/turbulence.h"
#include "skein/role/wind_field.h"

namespace skein::simulation {

/// A span of time in which an entity takes part; `until` is exclusive.
struct ActiveSpan {
  Time from;
  Time until;
};

/// The flying part of an entity.
struct Vehicle {
  std::shared_ptr<const Plant> plant;
  std::unique_ptr<Autopilot> autopilot;
  std::vector<std::unique_ptr<Sensor>> sensors;  ///< of the autopilot
  std::vector<std::unique_ptr<Sensor>> payload;  ///< of the agent
  std::unique_ptr<Turbulence> turbulence;        ///< null: none
  std::vector<VehicleFault> faults;              ///< that are going to happen
  Time step;           ///< of sensors, autopilot and plant; divides the run's step
  VehicleState state;  ///< the truth
  Air air;             ///< that it flies in
};

/// An aircraft or a ground station: an agent and, for an aircraft, what it flies with.
struct Entity {
  std::string name;
  std::string kind;                  ///< "aircraft" or "station"
  std::unique_ptr<Agent> agent;      ///< never null
  std::unique_ptr<Vehicle> vehicle;  ///< null for a station
  Time agent_period;                 ///< a multiple of the step
  std::vector<ActiveSpan> active;    ///< in order of time; empty = never takes part
};

/// Everything that exists in a run. Entity k has EntityId k.
struct World {
  std::unique_ptr<Terrain> terrain;
  std::unique_ptr<WindField> wind;
  std::unique_ptr<Phenomenon> fire;
  std::unique_ptr<Radio> radio;
  std::vector<Entity> entities;
  std::vector<GroundObject> objects;
  std::vector<Zone> zones;  ///< known to all from the start; for the records
};

}  // namespace skein::simulation
