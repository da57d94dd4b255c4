#pragma once

#include <atomic>
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
  std::string wind;                ///< EAST,NORTH [m/s]
  std::string wind_from;           ///< SPEED,BEARING_DEG
  std::optional<double> altitude;  ///< above mean sea level [m]
  double start_time = 0;           ///< [s]
};

/// The two ends of a flight.
struct PlanEnds {
  std::string from, to;                         ///< EAST,NORTH,HEADING_DEG[,ALTITUDE]
  std::string from_geo, to_geo;                 ///< LAT,LON,HEADING_DEG[,ALTITUDE]
  bool from_course = false, to_course = false;  ///< headings are courses over ground
};

struct PlanConnectArguments {
  PlanSetting setting;
  PlanEnds ends;
  std::optional<double> climb, sink;  ///< largest rates [m/s]; none: level
  std::optional<double> arrive;       ///< after so many seconds; none: soonest
  PlanOutput output;
  std::string batch;               ///< CSV; - = standard input; empty: one connection
  std::string batch_output = "-";  ///< CSV; - = standard output
};

int plan_connect_command(const PlanConnectArguments& arguments);
int plan_batch_command(const PlanConnectArguments& arguments,
                       const std::atomic<bool>& stop);

}  // namespace skein::app
