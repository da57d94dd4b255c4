// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/perimeter/observation.h"
#include "skein/data/traffic/traffic.h"
#include "skein/geo/local_frame.h"
#include "skein/geo/polygon.h"
#include "skein/scenario/choice.h"
#include "skein/scenario/fields.h"
#include "skein/scenario/source.h"

namespace skein::scenario {

/// A thing on the ground, for cameras to find.
struct PlacedObject {
  std::string name = "object";
  ObjectClass what = ObjectClass::kPerson;
  Vec2 position = Vec2::Zero();  ///< at the start [m]
  Choice movement{"standing"};
  bool physical = false;         ///< it exists in reality
  std::optional<double> radius;  ///< of its body [m]; none: typical of its class
  std::optional<double> height;  ///< of its body [m]; none: typical of its class
};

/// What the server remembers of physical objects, and when it says that this was wrong.
struct ServerMemory {
  ForgettingRules forgetting;
  double moved = 5;           ///< beyond three standard deviations [m]
  double safety_radius = 10;  ///< [m]
};

/// A single gust that every aircraft meets: it rises and falls as 1 - cos.
struct GustEvent {
  Time at;
  Vec2 velocity = Vec2::Zero();  ///< where it is strongest; see in_body [m/s]
  double up = 0;                 ///< [m/s]
  bool in_body = false;          ///< the velocity is forward and right of the aircraft
  double length = 50;  ///< distance through the air from nothing to full strength [m]
  double hold = 0;     ///< distance at full strength [m]
};

/// The ground station puts a zone into force, or takes it back.
struct ZoneSwitch {
  Time at;
  bool on = true;
};

/// A no-fly zone: a ring, or a disc.
struct NoFlightZone {
  std::string name;
  std::optional<geo::Ring> ring;                 ///< [m]
  std::optional<Vec2> centre;                    ///< of a disc [m]
  std::optional<double> radius;                  ///< of a disc [m]
  std::optional<double> floor_msl, ceiling_msl;  ///< [m]; none: no limit
  std::optional<Time> from, until;               ///< forbidden then; none: no limit
  bool active = true;                            ///< in force from the start
  std::vector<ZoneSwitch> switches;
};

/// What surrounds the aircraft.
struct Environment {
  Choice terrain{"flat"};
  Choice wind{"uniform"};
  Choice turbulence{"none"};
  std::vector<GustEvent> gusts;
  std::vector<Choice> phenomena = {{"thesis"}};
  std::optional<Time> period;  ///< of moving phenomena; none: as the fire sensors need
  std::vector<geo::Ring> zone_rings;  ///< no-fly zones, at all altitudes and times [m]
  std::vector<NoFlightZone> zones;
  std::vector<PlacedObject> objects;
  ServerMemory memory;
};

/// How the aircraft of a group stand at the start.
enum class Placement {
  kOpposite,  ///< evenly around the centre: two on opposite sides
  kRing,      ///< as kOpposite, flying along the ring, clockwise on the map
  kLine,      ///< side by side on a line through the centre, across the heading
  kList,      ///< at given points
};

struct Start {
  Placement placement = Placement::kOpposite;
  Vec2 centre = Vec2::Zero();          ///< [m]
  double distance = 900;               ///< opposite, ring: from the centre [m]
  double first_bearing = 0;            ///< opposite, ring: where the first stands [rad]
  double spacing = 100;                ///< line: between neighbours [m]
  std::vector<Vec2> positions;         ///< list [m]
  std::optional<double> altitude_msl;  ///< [m]; none: altitude_agl above the ground
  bool on_ground = false;              ///< stands on the ground, whatever the altitudes
  bool held = true;                    ///< there, by a crew, until its motor has power
  std::optional<double> heading;       ///< [rad]; none: to the centre, ring: along it
};

/// Something that happens to one aircraft of a group.
struct Failure {
  enum class Kind {
    kLost,  ///< it crashes: silent for ever, or until it is replaced
    kLand,  ///< it lands
    // Of one part, the aircraft goes on:
    kMotor,
    kServoStuck,
    kServoLoose,
    kSensor,
    kBattery,
    kLink,
  };
  Time at;
  Kind kind = Kind::kLost;
  std::string part;           ///< which motor, servo or sensor; see the key
  int aircraft = 0;           ///< index in the group
  std::optional<Time> until;  ///< it takes part again from then on
};

/// Failures of one kind that happen to each aircraft of a group by chance.
struct RandomFailure {
  Failure::Kind kind = Failure::Kind::kLink;
  std::string part;
  Time mean_between = Time::from_seconds(3600);  ///< from the end of one to the next
  std::optional<Time> length;                    ///< none: until the end of the run
};

/// Aircraft that are equal but for their place.
struct AircraftGroup {
  std::string name = "scout";
  int count = 1;
  Choice vehicle{"simulated"};
  Choice plant{"kinematic"};
  double parameter_spread = 0;  ///< of each aircraft's own parameters, at most
  Choice autopilot{"path"};
  std::vector<Choice> sensors = {{"gnss"}, {"air-data"}, {"fire"}};
  Choice agent{"scout"};
  std::vector<Transmitter> transmits;  ///< by which other aircraft notice it
  std::optional<bool> physical;        ///< its body is real; none: unless it is simulated
  std::optional<Reality> observes;  ///< none: what is simulated here sees its own world
  std::string station;              ///< that it belongs to; empty: the first
  double altitude_agl = 120;        ///< [m]
  Time agent_period = Time::from_seconds(0.5);
  Start start;
  std::optional<Time> flight_step;  ///< of plant and autopilot; none: as the plant needs
  Time join;                        ///< takes part from this time on
  std::optional<Time> leave;        ///< lands at this time
  std::optional<Time> comeback;     ///< takes part again from this time on
  std::vector<Failure> failures;
  std::vector<RandomFailure> random_failures;
};

/// Other aircraft that are equal but for their place: they belong to nobody.
struct TrafficGroup {
  std::string name = "traffic";
  int count = 1;
  Choice flight{"straight"};
  Vec2 position = Vec2::Zero();  ///< when it comes [m]
  double spread = 0;             ///< each comes within so far of there, at random [m]
  double altitude_msl = 300;     ///< when it comes [m]
  std::vector<Transmitter> transmits = {Transmitter::kAdsB, Transmitter::kTransponder};
  std::optional<std::uint32_t> address;  ///< that it sends; none: one of its own
  Time join;
  std::optional<Time> leave;
};

/// How the team of a ground station, its aircraft and itself, leads itself.
struct TeamSetup {
  enum class Structure {
    kNone,         ///< it does not: the station gives orders
    kLeader,       ///< one of the aircraft, elected by all
    kFixedLeader,  ///< the station, always
    kAuction,      ///< nobody: tasks go to the highest bids
  };
  enum class Allocation {
    kCoalitions,  ///< one task each, by what they need, as set partitioning
    kSequences,   ///< several in order, so that all is done soon
    kNearest,
  };
  Structure structure = Structure::kNone;
  Allocation allocation = Allocation::kCoalitions;
  std::optional<Time> query_period;  ///< none: as the radio has room for
  std::optional<double> diameter;    ///< of its mission [m]; none: of the tasks known
  bool approval = false;             ///< allocations wait for the operator
};

/// A ground station, which pursues missions and gives orders.
struct Station {
  std::string name = "station";
  Vec2 position = Vec2::Zero();  ///< [m]
  double antenna_agl = 5;        ///< height above the ground [m]
  Time agent_period = Time::from_seconds(0.5);
  std::optional<Time> heartbeat;  ///< between heartbeats; none: as autopilots need
  TeamSetup team;
};

struct Recording {
  double rate_hz = 10;
  Time metrics_period = Time::from_seconds(5);
  Time perimeter_period = Time::from_seconds(10);
  Time radio_period = Time::from_seconds(10);
  bool messages = true;
};

/// A place where ground stations' programs meet the aircraft by MAVLink.
struct StationLink {
  /// What frames without a signature may do.
  enum class Unsigned {
    kAuto,       ///< signed links: nothing; else on this machine all, beyond it telemetry
    kAll,        ///< whatever signed ones may
    kTelemetry,  ///< report and ask
  };
  std::string endpoint = "udpout:127.0.0.1:14550";  ///< see docs/links.md
  bool is_signed = false;                           ///< with the key of Links
  Unsigned unsigned_frames = Unsigned::kAuto;
};

/// What simulated aircraft look like to ground stations.
enum class ShownAs { kArduPilot, kPx4 };

/// Who else takes part, by MAVLink.
struct Links {
  std::vector<StationLink> ground_stations;
  ShownAs autopilot = ShownAs::kArduPilot;
  int first_system = 1;  ///< MAVLink system id of the first aircraft that is shown
  std::string key_file;  ///< of signed links; empty: none
};

/// A command that the scenario gives by itself.
struct PlannedCommand {
  Time at;
  std::string text;  ///< see data/command/command_text.h
};

/// A run, as its file describes it. Members hold SI units and radians; keys, ranges and
/// meanings stand in scenario_fields.cpp, defaults only here.
struct Scenario {
  std::string name = "unnamed";
  std::vector<std::string> plugins;  ///< shared libraries with kinds of their own
  std::uint64_t seed = 1;
  Time duration = Time::from_seconds(3600);
  Time step = Time::from_seconds(0.1);
  geo::Geodetic origin{36.989, -122.0514, 0};
  std::string start_utc = "2026-07-01T12:00:00Z";
  Environment environment;
  std::vector<AircraftGroup> aircraft = {AircraftGroup{}};
  std::vector<TrafficGroup> traffic;
  Choice radio{"ideal"};
  std::vector<Station> stations = {Station{}};
  std::vector<Choice> missions = {{"perimeter"}};
  std::vector<PlannedCommand> commands;
  Links links;
  Recording record;
  Source source = {};  ///< what it was read from; no key
};

/// The keys of a scenario file.
Fields<Scenario> scenario_fields();

}  // namespace skein::scenario
