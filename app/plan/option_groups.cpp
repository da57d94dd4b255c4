// SPDX-License-Identifier: Apache-2.0
#include "app/plan/option_groups.h"

#include "app/common/number_range.h"

namespace skein::app {

void add_output(CLI::App& command, PlanOutput& output) {
  command
      .add_option(
          "--out", output.files,
          "A file; the ending says the format: .geojson .csv .kml .plan .waypoints "
          ".svg .html. Several are allowed.")
      ->take_all()
      ->allow_extra_args(false);
  command.add_flag("--json", output.json, "Print as JSON.");
  command
      .add_option("--tolerance-m", output.tolerance,
                  "Straight legs between points of files leave the plan by at most so "
                  "many metres; default 1.")
      ->check(number_in(0.001, 1000.0));
  command
      .add_option("--step-s", output.step,
                  "Longest time between two rows of a CSV file; default 1.")
      ->check(number_in(0.001, 1e6));
}

void add_setting(CLI::App& command, PlanSetting& setting) {
  command.add_option("--origin", setting.origin,
                     "LAT,LON of the local frame's origin in degrees.");
  command.add_option("--airspeed", setting.airspeed, "m/s.")
      ->check(number_in(0.01, 1000.0));
  command
      .add_option("--turn-radius", setting.turn_radius,
                  "The smallest, in the air mass, in metres.")
      ->check(number_in(0.01, 1e5));
  command.add_option("--wind", setting.wind,
                     "NORTH,EAST in m/s: the air's velocity. Default: none.");
  command.add_option("--wind-from", setting.wind_from,
                     "SPEED,BEARING_DEG: the same by its speed and where it comes from.");
  command
      .add_option("--altitude-m", setting.altitude,
                  "Above mean sea level, for ends without an altitude of their own.")
      ->check(number_in(-20000.0, 20000.0));
  command.add_option("--start-s", setting.start_time, "Time of the start; default 0.")
      ->check(number_in(-1e9, 1e9));
}

void add_limits(CLI::App& command, PlanLimits& limits) {
  command.add_option("--climb", limits.climb, "Largest climb rate in m/s; default 3.")
      ->check(number_in(0.001, 1000.0));
  command.add_option("--sink", limits.sink, "Largest sink rate in m/s; default 3.")
      ->check(number_in(0.001, 1000.0));
  add_climb_acceleration(command, limits.climb_acceleration);
}

void add_climb_acceleration(CLI::App& command, double& acceleration) {
  command
      .add_option("--climb-acceleration", acceleration,
                  "Largest change of the climb rate in m/s^2: climbs begin and end by "
                  "vertical turns; default: at once.")
      ->check(number_in(0.001, 1000.0));
}

void add_speeds(CLI::App& command, PlanLimits& limits) {
  command
      .add_option("--slowest", limits.slowest, "Minimum airspeed; default: --airspeed.")
      ->check(number_in(0.01, 1000.0));
  command
      .add_option("--fastest", limits.fastest, "Largest airspeed; default: --airspeed.")
      ->check(number_in(0.01, 1000.0));
}

void add_repeated(CLI::App& command, const std::string& name,
                  std::vector<std::string>& target, const std::string& help) {
  command.add_option(name, target, help)->take_all()->allow_extra_args(false);
}

void add_metres(CLI::App& command, PlanMaps& maps) {
  command.add_flag("--map-metres", maps.metres,
                   "Coordinates of map files are metres to east and north, also with an "
                   "origin.");
}

void add_zones(CLI::App& command, PlanMaps& maps) {
  add_repeated(command, "--zones", maps.zones,
               "GeoJSON or KML: no-fly zones. Several are allowed.");
}

void add_obstacles(CLI::App& command, PlanMaps& maps) {
  add_repeated(command, "--obstacles", maps.obstacles,
               "GeoJSON or KML: moving obstacles. Several are allowed.");
}

}  // namespace skein::app
