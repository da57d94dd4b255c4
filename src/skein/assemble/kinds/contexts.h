// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/assemble/kinds/aircraft_gains.h"
#include "skein/base/id.h"
#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/airspace/zone.h"
#include "skein/data/perimeter/fire.h"
#include "skein/data/vehicle/airframe.h"
#include "skein/data/vehicle/flight_plan.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/geo/local_frame.h"
#include "skein/geo/rotation.h"

namespace skein {
class PathPlanner;
class Terrain;
class WindField;
}  // namespace skein

namespace skein::modem {
class ModemLink;
}

namespace skein::reasoning {
struct OnboardTeamOptions;
class TeamServer;
}  // namespace skein::reasoning

namespace skein::assemble {

struct KindsByRole;
class TaskKinds;

/// What every terrain, wind and fire is given besides its options.
struct EnvironmentContext {
  const geo::LocalFrame& frame;
  std::string start_utc;  ///< simulated time 0
  std::uint64_t seed = 0;
  const Terrain* terrain = nullptr;  ///< null while the terrain itself is made
  const WindField* wind = nullptr;   ///< null until the wind is made
  std::vector<std::string>* warnings = nullptr;  ///< what was repaired in the data
};

/// What every movement of an object on the ground is given besides its options.
struct ObjectContext {
  std::uint64_t seed = 0;
  std::uint32_t object = 0;   ///< its number
  Vec2 begin = Vec2::Zero();  ///< where it is at the start [m]
};

/// What every behaviour of other air traffic is given besides its options.
struct TrafficContext {
  std::uint64_t seed = 0;
  const geo::LocalFrame& frame;
  std::string start_utc;      ///< simulated time 0
  std::string name;           ///< of the aircraft
  std::uint32_t traffic = 0;  ///< its number
  std::size_t index = 0;      ///< in its group
  std::size_t count = 1;      ///< of its group
  Vec3 begin = Vec3::Zero();  ///< where it is when it comes, in N [m]
  /// The aircraft of that name that takes part; of no name, the first.
  std::function<std::optional<EntityId>(const std::string&)> find;
  std::vector<std::string>* warnings = nullptr;  ///< about recorded data
  std::any* shared = nullptr;  ///< what the aircraft of a group have in common
  double duration = 0;         ///< of the run [s]
};

/// Whether environment.phenomena has one of that number.
/// Fails: kBadInput, at the key `phenomenon`.
Result<void> check_phenomenon(std::size_t number, std::size_t phenomena);

/// What every part of an aircraft is given besides its options.
struct AircraftContext {
  std::uint64_t seed = 0;
  EntityId self;
  std::uint32_t instance = 0;  ///< number among its sensors of one kind, from 0
  EntityId station;
  Time agent_period;
  std::size_t index = 0;                       ///< in its group
  double altitude_agl = 0;                     ///< flight altitude above ground [m]
  std::shared_ptr<const Terrain> map;          ///< the terrain as the agent knows it
  std::vector<Zone> zones;                     ///< in force from the start
  std::size_t phenomena = 0;                   ///< how many there are
  std::shared_ptr<const PathPlanner> planner;  ///< of routes around zones; null: none
  FlightLimits limits;                         ///< of the plant
  Airframe airframe;                           ///< of the plant
  NavEstimate initial;                         ///< where and how it flies at the start
  bool on_ground = false;                      ///< at the start
  AircraftGains gains;                         ///< of the plant's file
  bool receives_station = false;               ///< the station sends heartbeats
  bool has_position = false;                   ///< a sensor says where it is
  bool has_camera = false;                     ///< a sensor finds objects
  bool has_fire_sensor = false;                ///< a sensor looks at the fire
  bool finds_aircraft = false;                 ///< a sensor finds other aircraft
  /// Those of its team that find other aircraft: they are told where it is, lest they
  /// take it for one.
  std::vector<EntityId> watchers;
  std::shared_ptr<const TaskKinds> tasks;  ///< what flies tasks; null: nothing does
  /// How it takes part in a team that leads itself; null: it does not.
  std::shared_ptr<const reasoning::OnboardTeamOptions> team;
  std::uint8_t fitted = 0;      ///< bit k: FlightSensor k is on board
  std::any* shared = nullptr;   ///< what the autopilots of a group have in common
  double parameter_spread = 0;  ///< of the plant's parameters, at most
  double place_period = 1;      ///< SeparationOptions [s]
};

/// An aircraft of a ground station, as missions choose theirs.
struct TeamAircraft {
  EntityId id;
  std::string name, group;
  Vec2 place = Vec2::Zero();  ///< where it begins [m]
  bool has_camera = false, has_fire_sensor = false;
};

/// A ground station with its aircraft.
struct StationTeam {
  EntityId id;
  std::string name;
  std::vector<TeamAircraft> team;
  /// Its own, for all its missions; none: its team does not lead itself.
  std::function<std::shared_ptr<reasoning::TeamServer>()> desk;
};

/// What every mission is given besides its options.
struct MissionContext {
  std::uint64_t seed = 0;
  const KindsByRole& kinds;  ///< of its parts
  std::vector<StationTeam> stations;
  const std::vector<Zone>& zones;    ///< in force from the start
  std::vector<std::string> objects;  ///< names of the environment's, by their numbers
  std::shared_ptr<const PathPlanner> planner;
  Time metrics_period;
  /// The plan in a file.
  std::function<Result<FlightPlan>(const std::string& file)> read_plan;
  std::size_t phenomena = 0;  ///< how many the environment has
};

/// What every radio is given besides its options.
struct RadioContext {
  std::uint64_t seed = 0;
  std::size_t entities = 0;  ///< all of the run, those that come late too
  std::function<std::optional<Vec3>(EntityId)> position;
  std::function<std::string(EntityId)> name;
  /// R_NB of an entity now; level and to the north where it has none.
  std::function<Mat3(EntityId)> attitude = {};
  std::size_t stations = 0;            ///< the first entities, which are no aircraft
  const Terrain* terrain = nullptr;    ///< of the run; outlives the radio
  modem::ModemLink* modem = nullptr;   ///< of the run; null: there is none
  const KindsByRole* kinds = nullptr;  ///< of its parts; outlive this
};

/// What every routing protocol is given besides its options.
struct RoutingContext {
  std::uint64_t seed = 0;
  std::size_t entities = 0;  ///< all of the run
};

/// What every estimator is given besides its options.
struct EstimatorContext {
  std::uint64_t seed = 0;
  PerimeterPrior prior;
};

}  // namespace skein::assemble
