// SPDX-License-Identifier: Apache-2.0
// Options of skein plan connect and path: from one place to another.
#include <CLI/CLI.hpp>

#include "app/common/number_range.h"
#include "app/plan/commands.h"
#include "app/plan/option_groups.h"

namespace skein::app {
namespace {

constexpr const char* kConnectExamples = R"(
Places are NORTH,EAST in metres, headings degrees clockwise from north.

Examples:
  skein plan connect --from 0,0,90 --to 400,600,0 --airspeed 15 --turn-radius 60
  skein plan connect --from-geo 50.05,14.4,90 --to-geo 50.06,14.42,0 --airspeed 15 \
      --turn-radius 60 --wind-from 5,270 --altitude-m 400 --out flight.plan --out flight.html
  skein plan connect --batch cases.csv > answers.csv
  producer | skein plan connect --batch - | consumer)";

constexpr const char* kPathExamples = R"(
Examples:
  skein plan path --from-geo 50.05,14.40,90 --to-geo 50.08,14.45,0 --zones zones.geojson \
      --airspeed 15 --turn-radius 60 --wind-from 5,270 --out path.html
  skein plan path --from 100,100,90 --to 1900,1900,0 --zones scene.geojson --airspeed 15 \
      --turn-radius 60 --time-limit-ms 500      coordinates in metres)";

void add_ends(CLI::App& command, PlanEnds& ends) {
  command.add_option("--from", ends.from, "NORTH,EAST,HEADING_DEG[,ALTITUDE] in metres.");
  command.add_option("--to", ends.to, "NORTH,EAST,HEADING_DEG[,ALTITUDE] in metres.");
  command.add_option("--from-geo", ends.from_geo,
                     "LAT,LON,HEADING_DEG[,ALTITUDE]; the origin, unless --origin is.");
  command.add_option("--to-geo", ends.to_geo, "LAT,LON,HEADING_DEG[,ALTITUDE].");
  command.add_flag("--from-course", ends.from_course,
                   "The start's heading is a course over ground.");
  command.add_flag("--to-course", ends.to_course,
                   "The goal's heading is a course over ground.");
}

}  // namespace

CLI::App* add_connect(CLI::App& plan, PlanConnectArguments& given) {
  CLI::App& command = *plan.add_subcommand(
      "connect",
      "The quickest flight of one Dubins word between two poses in a steady wind.");
  add_ends(command, given.ends);
  add_setting(command, given.setting);
  command.add_option("--climb", given.climb, "Largest climb rate in m/s.")
      ->check(number_in(0.001, 1000.0));
  command.add_option("--sink", given.sink, "Largest sink rate in m/s.")
      ->check(number_in(0.001, 1000.0));
  add_climb_acceleration(command, given.climb_acceleration);
  command
      .add_option("--arrive-s", given.arrive,
                  "A flight that takes just so many seconds instead of the quickest: a "
                  "duration, whatever --start-s is.")
      ->check(number_in(0.0, 1e6));
  add_output(command, given.output);
  const auto others = command.get_options();
  auto* batch = command.add_option(
      "--batch", given.batch,
      "A CSV table of connections, answered row by row; - = standard input.");
  for (CLI::Option* other : others)
    if (other != command.get_help_ptr()) batch->excludes(other);
  command
      .add_option("--output", given.batch_output,
                  "CSV of the batch's answers; - = standard output, the default.")
      ->needs(batch);
  command.footer(kConnectExamples);
  return &command;
}

CLI::App* add_path(CLI::App& plan, PlanPathArguments& given) {
  CLI::App& command = *plan.add_subcommand(
      "path", "A quick path around zones, terrain and moving obstacles, with a bound.");
  add_ends(command, given.ends);
  add_setting(command, given.setting);
  add_limits(command, given.limits);
  add_zones(command, given.maps);
  add_obstacles(command, given.maps);
  add_metres(command, given.maps);
  command.add_option("--terrain", given.terrain,
                     "Elevation raster; the ground is kept clear of.");
  command.add_option("--clearance-m", given.clearance, "Above the ground; default 0.")
      ->check(number_in(0.0, 10000.0))
      ->needs("--terrain");
  command.add_option("--floor-m", given.floor, "Minimum altitude.")
      ->check(number_in(-20000.0, 20000.0));
  command.add_option("--ceiling-m", given.ceiling, "Largest altitude.")
      ->check(number_in(-20000.0, 20000.0));
  command.add_option("--planner", given.planner, "aastar (default) or tangent.")
      ->check(CLI::IsMember({"aastar", "tangent"}));
  command
      .add_option_function<double>(
          "--time-limit-ms", [&given](double ms) { given.time_limit = ms / 1000; },
          "End with the best path after so long; the first one is always looked for.")
      ->check(number_in(0.0, 1e9));
  command
      .add_option("--expansions,--states", given.expansions,
                  "End after so many expansions; default 100000, without end "
                  "with --time-limit-ms.")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 60));
  command.add_flag("--first", given.first, "End with the first path.");
  add_output(command, given.output);
  command.footer(kPathExamples);
  return &command;
}

}  // namespace skein::app
