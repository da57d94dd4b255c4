// SPDX-License-Identifier: Apache-2.0
// Options of skein plan coverage, patrol, orbit and rendezvous.
#include <CLI/CLI.hpp>

#include "app/common/number_range.h"
#include "app/plan/commands.h"
#include "app/plan/option_groups.h"

namespace skein::app {
namespace {

constexpr const char* kCoverageExamples = R"(
Examples:
  skein plan coverage --area field.geojson --origin 50.05,14.40 --swath-m 80 --airspeed 15 \
      --turn-radius 60 --wind-from 5,270 --altitude-m 400 --out survey.plan --out survey.html
  skein plan coverage --area field.geojson --from 0,0,0 --from 0,50,0 --return \
      --swath-m 80 --airspeed 15 --turn-radius 60      two aircraft, coordinates in metres)";

constexpr const char* kPatrolExamples = R"(
Examples:
  skein plan patrol --line pipe.geojson --from-geo 50.05,14.40,90 --airspeed 15 \
      --turn-radius 60 --offset-m 30 --rounds 2 --out patrol.html)";

constexpr const char* kOrbitExamples = R"(
Examples:
  skein plan orbit --target 600,800 --from 0,0,90 --radius-m 150 --airspeed 15 \
      --turn-radius 60 --wind-from 4,300 --out orbit.svg
  skein plan orbit --target 600,800 --target-velocity 0,6 --kind weave --from 0,0,90 \
      --airspeed 15 --turn-radius 60)";

constexpr const char* kRendezvousExamples = R"(
Examples:
  skein plan rendezvous --from 0,0,0 --to 900,900,90 --from 0,2000,0 --to 900,950,90 \
      --airspeed 15 --slowest 13 --fastest 18 --turn-radius 60)";

// What all tasks have: where aircraft start, and how they fly.
template <class Arguments>
void add_flight(CLI::App& command, Arguments& given) {
  add_repeated(command, "--from", given.starts.from,
               "NORTH,EAST,HEADING_DEG[,ALTITUDE] in metres; one for each aircraft.");
  add_repeated(command, "--from-geo", given.starts.from_geo,
               "LAT,LON,HEADING_DEG[,ALTITUDE]; the first is the origin, unless --origin "
               "is.");
  add_setting(command, given.setting);
  add_limits(command, given.limits);
}

// For tasks that do not look at obstacles: they are only reported.
void add_checked(CLI::App& command, PlanMaps& maps) {
  add_zones(command, maps);
  add_obstacles(command, maps);
  add_metres(command, maps);
}

}  // namespace

CLI::App* add_coverage(CLI::App& plan, PlanCoverageArguments& given) {
  CLI::App& command =
      *plan.add_subcommand("coverage", "Parallel sweeps over an area, in wind.");
  command.add_option("--area", given.area, "GeoJSON or KML: the area, with holes.")
      ->required();
  add_flight(command, given);
  add_zones(command, given.maps);
  add_metres(command, given.maps);
  command.add_option("--swath-m", given.swath, "Width that the sensor sees.")
      ->required()
      ->check(number_in(0.1, 1e5));
  command
      .add_option("--overlap", given.overlap,
                  "Share of the swath that neighbours have in common; default 0.")
      ->check(number_in(0.0, 0.95));
  command
      .add_option("--overshoot-m", given.overshoot,
                  "Lines begin earlier and end later by so much; default 0.")
      ->check(number_in(0.0, 1e5));
  command
      .add_option("--zone-distance-m", given.zone_distance,
                  "Lines keep so far from zones; default 0.")
      ->check(number_in(0.0, 1e5));
  command.add_option("--bearing-deg", given.bearing_deg, "Default: the quickest found.")
      ->check(number_in(-360.0, 360.0));
  command
      .add_option("--aircraft", given.aircraft,
                  "How many; default: as many as there are starts, or 1.")
      ->check(CLI::Range(1, 64));
  command.add_flag("--return", given.back, "Each ends where it starts.");
  add_output(command, given.output);
  command.footer(kCoverageExamples);
  return &command;
}

CLI::App* add_patrol(CLI::App& plan, PlanPatrolArguments& given) {
  CLI::App& command =
      *plan.add_subcommand("patrol", "Along a line, there and back or around.");
  command
      .add_option("--line", given.line,
                  "GeoJSON or KML: the line, or an area whose rim is meant.")
      ->required();
  add_flight(command, given);
  add_speeds(command, given.limits);
  add_checked(command, given.maps);
  command.add_flag("--closed", given.closed, "Around, instead of there and back.");
  command
      .add_option("--offset-m", given.offset,
                  "To the right of the line as it is drawn; negative: left. Default 0.")
      ->check(number_in(-1e5, 1e5));
  command.add_option("--corners", given.corners, "rounded (default) or flown-over.")
      ->check(CLI::IsMember({"rounded", "flown-over"}));
  command
      .add_option("--corner-tolerance-m", given.corner_tolerance,
                  "Largest distance of line and flight at a corner; default 20.")
      ->check(number_in(0.001, 1e5));
  auto* rounds = command.add_option("--rounds", given.rounds, "Default 1.")
                     ->check(CLI::Range(1, 5000));
  command.add_option("--until-s", given.until, "As many passes as end by then.")
      ->check(number_in(-1e9, 1e9))
      ->excludes(rounds);
  add_output(command, given.output);
  command.footer(kPatrolExamples);
  return &command;
}

CLI::App* add_orbit(CLI::App& plan, PlanOrbitArguments& given) {
  CLI::App& command =
      *plan.add_subcommand("orbit", "Circles or S-turns over a target that may move.");
  command.add_option("--target", given.target, "NORTH,EAST in metres, at the start.");
  command.add_option("--target-geo", given.target_geo, "LAT,LON, at the start.");
  command.add_option("--target-velocity", given.velocity,
                     "NORTH,EAST in m/s; default: it stays.");
  add_flight(command, given);
  add_speeds(command, given.limits);
  add_checked(command, given.maps);
  command.add_option("--kind", given.kind, "circle (default) or weave: S-turns.")
      ->check(CLI::IsMember({"circle", "weave"}));
  command
      .add_option("--side", given.side, "clockwise, anticlockwise or either (default).")
      ->check(CLI::IsMember({"either", "clockwise", "anticlockwise"}));
  command.add_option("--radius-m", given.radius, "Of the circle; default 150.")
      ->check(number_in(0.1, 1e6));
  command
      .add_option("--error-m", given.error,
                  "Largest error of the distance on the circle; default 1.")
      ->check(number_in(0.001, 1e5));
  command.add_option("--duration-s", given.duration, "With the target; default 300.")
      ->check(number_in(0.001, 1e6));
  add_output(command, given.output);
  command.footer(kOrbitExamples);
  return &command;
}

CLI::App* add_rendezvous(CLI::App& plan, PlanRendezvousArguments& given) {
  CLI::App& command = *plan.add_subcommand(
      "rendezvous", "Several aircraft at their goals at one time, or in a row.");
  add_flight(command, given);
  add_repeated(command, "--to", given.to,
               "NORTH,EAST,HEADING_DEG[,ALTITUDE] in metres; one for each aircraft.");
  add_repeated(command, "--to-geo", given.to_geo, "LAT,LON,HEADING_DEG[,ALTITUDE].");
  add_speeds(command, given.limits);
  add_checked(command, given.maps);
  command.add_option("--time-s", given.time, "Of the first arrival; default: soonest.")
      ->check(number_in(-1e9, 1e9));
  command.add_option("--spacing-s", given.spacing, "Between arrivals; default 0.")
      ->check(number_in(0.0, 1e6));
  add_output(command, given.output);
  command.footer(kRendezvousExamples);
  return &command;
}

}  // namespace skein::app
