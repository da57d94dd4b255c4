#pragma once

#include <any>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/assemble/aircraft_gains.h"
#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/airframe.h"
#include "skein/data/fire.h"
#include "skein/data/vehicle.h"
#include "skein/data/zone.h"
#include "skein/geo/local_frame.h"

namespace skein {
class PathPlanner;
class Terrain;
class WindField;
namespace scenario {
struct Scenario;
}
}  // namespace skein

namespace skein::assemble {

struct KindsByRole;

/// What every terrain, wind and fire is given besides its options.
struct EnvironmentContext {
  const geo::LocalFrame& frame;
  std::string start_utc;  ///< simulated time 0
  std::uint64_t seed = 0;
  const Terrain* terrain = nullptr;  ///< null while the terrain itself is made
  const WindField* wind = nullptr;   ///< null until the wind is made
  std::vector<std::string>* warnings = nullptr;  ///< what was repaired in the data
};

/// What every part of an aircraft is given besides its options.
struct AircraftContext {
  std::uint64_t seed = 0;
  EntityId self;
  std::uint32_t instance = 0;  ///< number among its sensors of one kind, from 0
  EntityId station;
  Time agent_period;
  double altitude_agl = 0;                     ///< flight altitude above ground [m]
  std::shared_ptr<const Terrain> map;          ///< the terrain as the agent knows it
  std::vector<Zone> zones;                     ///< in force from the start
  std::shared_ptr<const PathPlanner> planner;  ///< of routes around zones; null: none
  FlightLimits limits;                         ///< of the plant
  Airframe airframe;                           ///< of the plant
  NavEstimate initial;                         ///< where and how it flies at the start
  bool on_ground = false;                      ///< at the start
  AircraftGains gains;                         ///< of the plant's file
  bool hears_station = false;                  ///< the station sends heartbeats
  bool has_position = false;                   ///< a sensor says where it is
  bool has_camera = false;                     ///< a sensor finds objects
  std::uint8_t fitted = 0;                     ///< bit k: FlightSensor k is on board
  std::any* shared = nullptr;   ///< what the autopilots of a group have in common
  double parameter_spread = 0;  ///< of the plant's parameters, at most
};

/// What every ground station's agent is given besides its options.
struct StationContext {
  const scenario::Scenario& scenario;
  const KindsByRole& kinds;    ///< of its parts
  std::vector<EntityId> team;  ///< all aircraft
  const std::vector<Zone>& zones;
};

/// What every radio is given besides its options.
struct RadioContext {
  std::uint64_t seed = 0;
  std::function<std::optional<Vec3>(EntityId)> position;
};

/// What every estimator is given besides its options.
struct EstimatorContext {
  std::uint64_t seed = 0;
  PerimeterPrior prior;
};

}  // namespace skein::assemble
