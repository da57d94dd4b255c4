// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein::app {

/// What all commands of `skein plan` write. Texts of options are as they were given; they
/// are read when the command runs, so that all that is wrong has the same kind of
/// message.
struct PlanOutput {
  std::vector<std::filesystem::path> files;  ///< the ending says the format
  bool json = false;
  double tolerance = 1;  ///< [m]
  double step = 1;       ///< [s]
};

/// Where a plan is, and in which air it is flown.
struct PlanSetting {
  std::string origin;  ///< LAT,LON
  std::optional<double> airspeed, turn_radius;
  std::string wind;                ///< NORTH,EAST [m/s]
  std::string wind_from;           ///< SPEED,BEARING_DEG
  std::optional<double> altitude;  ///< above mean sea level [m]
  double start_time = 0;           ///< [s]
};

/// The two ends of a flight.
struct PlanEnds {
  std::string from, to;                         ///< NORTH,EAST,HEADING_DEG[,ALTITUDE]
  std::string from_geo, to_geo;                 ///< LAT,LON,HEADING_DEG[,ALTITUDE]
  bool from_course = false, to_course = false;  ///< headings are courses over ground
};

/// What aircraft can do beside their setting.
struct PlanLimits {
  double climb = 3, sink = 3;              ///< largest rates [m/s]
  double climb_acceleration = 0;           ///< largest [m/s^2]; 0: not bounded
  std::optional<double> slowest, fastest;  ///< [m/s]; none: the airspeed
};

/// Where aircraft start, one for each.
struct PlanStarts {
  std::vector<std::string> from;      ///< NORTH,EAST,HEADING_DEG[,ALTITUDE]
  std::vector<std::string> from_geo;  ///< LAT,LON,HEADING_DEG[,ALTITUDE]
};

/// Map files and how their coordinates are meant.
struct PlanMaps {
  std::vector<std::string> zones;      ///< files
  std::vector<std::string> obstacles;  ///< files
  bool metres = false;                 ///< coordinates are metres also with an origin
};

struct PlanConnectArguments {
  PlanSetting setting;
  PlanEnds ends;
  std::optional<double> climb, sink;  ///< largest rates [m/s]; none: level
  double climb_acceleration = 0;      ///< largest [m/s^2]; 0: not bounded
  std::optional<double> arrive;       ///< after so many seconds; none: soonest
  PlanOutput output;
  std::string batch;               ///< CSV; - = standard input; empty: one connection
  std::string batch_output = "-";  ///< CSV; - = standard output
};

struct PlanPathArguments {
  PlanSetting setting;
  PlanEnds ends;
  PlanLimits limits;
  PlanMaps maps;
  std::string terrain;                   ///< raster file; empty: no ground
  double clearance = 0;                  ///< above the ground [m]
  std::optional<double> floor, ceiling;  ///< altitudes to keep within [m]
  std::string planner = "aastar";
  std::optional<double> time_limit;        ///< [s]
  std::optional<std::int64_t> expansions;  ///< at most
  bool first = false;                      ///< end with the first path
  PlanOutput output;
};

struct PlanCoverageArguments {
  PlanSetting setting;
  PlanStarts starts;
  PlanLimits limits;
  PlanMaps maps;
  std::string area;  ///< map file
  double swath = 0, overlap = 0, overshoot = 0, zone_distance = 0;
  std::optional<double> bearing_deg;
  int aircraft = 1;
  bool back = false;  ///< each ends where it starts
  PlanOutput output;
};

struct PlanPatrolArguments {
  PlanSetting setting;
  PlanStarts starts;
  PlanLimits limits;
  PlanMaps maps;
  std::string line;  ///< map file
  bool closed = false;
  double offset = 0, corner_tolerance = 20;
  std::string corners = "rounded";
  int rounds = 1;
  std::optional<double> until;
  PlanOutput output;
};

struct PlanOrbitArguments {
  PlanSetting setting;
  PlanStarts starts;
  PlanLimits limits;
  PlanMaps maps;
  std::string target, target_geo;  ///< NORTH,EAST or LAT,LON at the start time
  std::string velocity;            ///< NORTH,EAST [m/s]
  std::string kind = "circle", side = "either";
  double radius = 150, error = 1, duration = 300;
  PlanOutput output;
};

struct PlanRendezvousArguments {
  PlanSetting setting;
  PlanStarts starts;
  std::vector<std::string> to, to_geo;
  PlanLimits limits;
  PlanMaps maps;
  std::optional<double> time;
  double spacing = 0;
  PlanOutput output;
};

struct PlanFleetArguments {
  PlanSetting setting;
  PlanLimits limits;
  PlanMaps maps;
  std::string cases;                   ///< CSV: a row for each aircraft
  std::optional<double> latest_start;  ///< [s]; none: the earliest of each
  double radius = 30, height = 20;     ///< of each room [m]
  double ahead = 5, behind = 10;       ///< [s]
  std::int64_t expansions = 3000;      ///< of each search, at most
  PlanOutput output;
};

int plan_connect_command(const PlanConnectArguments& arguments);
int plan_batch_command(const PlanConnectArguments& arguments,
                       const std::atomic<bool>& stop);
int plan_path_command(const PlanPathArguments& arguments, const std::atomic<bool>& stop);
int plan_coverage_command(const PlanCoverageArguments& arguments,
                          const std::atomic<bool>& stop);
int plan_patrol_command(const PlanPatrolArguments& arguments);
int plan_orbit_command(const PlanOrbitArguments& arguments);
int plan_rendezvous_command(const PlanRendezvousArguments& arguments);
int plan_fleet_command(const PlanFleetArguments& arguments,
                       const std::atomic<bool>& stop);

}  // namespace skein::app
