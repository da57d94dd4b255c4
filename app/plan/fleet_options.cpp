// SPDX-License-Identifier: Apache-2.0
// Options of skein plan fleet: many aircraft, each from its start to its goal.
#include <CLI/CLI.hpp>

#include "app/common/number_range.h"
#include "app/plan/commands.h"
#include "app/plan/option_groups.h"

namespace skein::app {
namespace {

constexpr const char* kFleetExamples = R"(
The table has a header line and a row for each aircraft, those of higher priority first:
  name,start_north_m,start_east_m,start_heading_deg,goal_north_m,goal_east_m,goal_heading_deg
and, where wanted, start_altitude_m, goal_altitude_m (default: --altitude-m),
earliest_start_s, latest_start_s;
..._latitude_deg and ..._longitude_deg in place of ..._north_m and ..._east_m.

Examples:
  skein plan fleet fleet.csv --airspeed 15 --turn-radius 60 --altitude-m 400 --out fleet.svg
  skein plan fleet fleet.csv --origin 50.05,14.40 --zones zones.geojson --airspeed 15 \
      --turn-radius 60 --wind-from 5,270 --altitude-m 400 --latest-start-s 300 \
      --out fleet.geojson --out fleet.csv)";

}  // namespace

CLI::App* add_fleet(CLI::App& plan, PlanFleetArguments& given) {
  CLI::App& command = *plan.add_subcommand(
      "fleet", "Flights of many aircraft that keep out of each other's rooms.");
  command.add_option("cases", given.cases, "CSV: a row for each aircraft.")->required();
  add_setting(command, given.setting);
  add_limits(command, given.limits);
  add_zones(command, given.maps);
  add_obstacles(command, given.maps);
  add_metres(command, given.maps);
  command
      .add_option("--latest-start-s", given.latest_start,
                  "Until when aircraft may wait for their start; default: each starts at "
                  "its earliest.")
      ->check(number_in(-1e9, 1e9));
  command
      .add_option("--room-radius-m", given.radius,
                  "Others keep so far from a flight; default 30.")
      ->check(number_in(0.1, 1e5));
  command
      .add_option("--room-height-m", given.height,
                  "Of the room, up and down; default 20.")
      ->check(number_in(0.0, 1e5));
  command
      .add_option("--ahead-s", given.ahead,
                  "The room holds where the aircraft will be so much later; default 5.")
      ->check(number_in(0.0, 3600.0));
  command
      .add_option("--behind-s", given.behind,
                  "The room holds where the aircraft was so much earlier; default 10.")
      ->check(number_in(0.0, 3600.0));
  command
      .add_option("--expansions", given.expansions,
                  "Each search for a detour ends after so many; default 3000.")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 60));
  add_output(command, given.output);
  command.footer(kFleetExamples);
  return &command;
}

}  // namespace skein::app
