#include "app/plan_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/number_range.h"
#include "app/plan_arguments.h"

namespace skein::app {
namespace {

constexpr const char* kConnectExamples = R"(
Places are metres to east and north, headings degrees clockwise from north.

Examples:
  skein plan connect --from 0,0,90 --to 600,400,0 --airspeed 15 --turn-radius 60
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

constexpr const char* kCoverageExamples = R"(
Examples:
  skein plan coverage --area field.geojson --origin 50.05,14.40 --swath-m 80 --airspeed 15 \
      --turn-radius 60 --wind-from 5,270 --altitude-m 400 --out survey.plan --out survey.html
  skein plan coverage --area field.geojson --from 0,0,0 --from 50,0,0 --return \
      --swath-m 80 --airspeed 15 --turn-radius 60      two aircraft, coordinates in metres)";

constexpr const char* kPatrolExamples = R"(
Examples:
  skein plan patrol --line pipe.geojson --from-geo 50.05,14.40,90 --airspeed 15 \
      --turn-radius 60 --offset-m 30 --rounds 2 --out patrol.html)";

constexpr const char* kOrbitExamples = R"(
Examples:
  skein plan orbit --target 800,600 --from 0,0,90 --radius-m 150 --airspeed 15 \
      --turn-radius 60 --wind-from 4,300 --out orbit.svg
  skein plan orbit --target 800,600 --target-velocity 6,0 --kind weave --from 0,0,90 \
      --airspeed 15 --turn-radius 60)";

constexpr const char* kRendezvousExamples = R"(
Examples:
  skein plan rendezvous --from 0,0,0 --to 900,900,90 --from 2000,0,0 --to 950,900,90 \
      --airspeed 15 --slowest 13 --fastest 18 --turn-radius 60)";

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
                     "EAST,NORTH in m/s: the air's velocity. Default: none.");
  command.add_option("--wind-from", setting.wind_from,
                     "SPEED,BEARING_DEG: the same by its speed and where it comes from.");
  command
      .add_option("--altitude-m", setting.altitude,
                  "Above mean sea level, for ends without an altitude of their own.")
      ->check(number_in(-20000.0, 20000.0));
  command.add_option("--start-s", setting.start_time, "Time of the start; default 0.")
      ->check(number_in(-1e9, 1e9));
}

void add_ends(CLI::App& command, PlanEnds& ends) {
  command.add_option("--from", ends.from, "EAST,NORTH,HEADING_DEG[,ALTITUDE] in metres.");
  command.add_option("--to", ends.to, "EAST,NORTH,HEADING_DEG[,ALTITUDE] in metres.");
  command.add_option("--from-geo", ends.from_geo,
                     "LAT,LON,HEADING_DEG[,ALTITUDE]; the origin, unless --origin is.");
  command.add_option("--to-geo", ends.to_geo, "LAT,LON,HEADING_DEG[,ALTITUDE].");
  command.add_flag("--from-course", ends.from_course,
                   "The start's heading is a course over ground.");
  command.add_flag("--to-course", ends.to_course,
                   "The goal's heading is a course over ground.");
}

void add_repeated(CLI::App& command, const std::string& name,
                  std::vector<std::string>& target, const std::string& help) {
  command.add_option(name, target, help)->take_all()->allow_extra_args(false);
}

void add_starts(CLI::App& command, PlanStarts& starts) {
  add_repeated(command, "--from", starts.from,
               "EAST,NORTH,HEADING_DEG[,ALTITUDE] in metres; one for each aircraft.");
  add_repeated(command, "--from-geo", starts.from_geo,
               "LAT,LON,HEADING_DEG[,ALTITUDE]; the first is the origin, unless --origin "
               "is.");
}

void add_limits(CLI::App& command, PlanLimits& limits) {
  command.add_option("--climb", limits.climb, "Largest climb rate in m/s; default 3.")
      ->check(number_in(0.001, 1000.0));
  command.add_option("--sink", limits.sink, "Largest sink rate in m/s; default 3.")
      ->check(number_in(0.001, 1000.0));
}

void add_speeds(CLI::App& command, PlanLimits& limits) {
  command.add_option("--slowest", limits.slowest, "Least airspeed; default: --airspeed.")
      ->check(number_in(0.01, 1000.0));
  command
      .add_option("--fastest", limits.fastest, "Largest airspeed; default: --airspeed.")
      ->check(number_in(0.01, 1000.0));
}

void add_metres(CLI::App& command, PlanMaps& maps) {
  command.add_flag("--map-metres", maps.metres,
                   "Coordinates of map files are metres to east and north, also with an "
                   "origin.");
}

void add_zones(CLI::App& command, PlanMaps& maps) {
  add_repeated(command, "--zones", maps.zones,
               "GeoJSON or KML: no-flight zones. Several are allowed.");
}

void add_obstacles(CLI::App& command, PlanMaps& maps) {
  add_repeated(command, "--obstacles", maps.obstacles,
               "GeoJSON or KML: moving obstacles. Several are allowed.");
}

// For tasks that do not look at what is in the way.
void add_checked(CLI::App& command, PlanMaps& maps) {
  add_zones(command, maps);
  add_obstacles(command, maps);
  add_metres(command, maps);
}

}  // namespace

struct PlanOptions::Parts {
  CLI::App* plan = nullptr;
  CLI::App* connect_command = nullptr;
  PlanConnectArguments connect;

  void add_connect() {
    connect_command = plan->add_subcommand(
        "connect", "The quickest flight between two poses in a steady wind.");
    CLI::App& command = *connect_command;
    add_ends(command, connect.ends);
    add_setting(command, connect.setting);
    command.add_option("--climb", connect.climb, "Largest climb rate in m/s.")
        ->check(number_in(0.001, 1000.0));
    command.add_option("--sink", connect.sink, "Largest sink rate in m/s.")
        ->check(number_in(0.001, 1000.0));
    command
        .add_option("--arrive-s", connect.arrive,
                    "A flight that takes just so many seconds instead of the quickest: a "
                    "duration, whatever --start-s is.")
        ->check(number_in(0.0, 1e6));
    add_output(command, connect.output);
    const auto others = command.get_options();
    auto* batch = command.add_option(
        "--batch", connect.batch,
        "A CSV table of connections, answered row by row; - = standard input.");
    for (CLI::Option* other : others)
      if (other != command.get_help_ptr()) batch->excludes(other);
    command
        .add_option("--output", connect.batch_output,
                    "CSV of the batch's answers; - = standard output, the default.")
        ->needs(batch);
    command.footer(kConnectExamples);
  }

  CLI::App* path_command = nullptr;
  PlanPathArguments path;

  void add_path() {
    path_command = plan->add_subcommand(
        "path", "The quickest path around zones, terrain and moving obstacles.");
    CLI::App& command = *path_command;
    add_ends(command, path.ends);
    add_setting(command, path.setting);
    add_limits(command, path.limits);
    add_zones(command, path.maps);
    add_obstacles(command, path.maps);
    add_metres(command, path.maps);
    command.add_option("--terrain", path.terrain,
                       "Elevation raster; the ground is kept clear of.");
    command.add_option("--clearance-m", path.clearance, "Above the ground; default 0.")
        ->check(number_in(0.0, 10000.0))
        ->needs("--terrain");
    command.add_option("--floor-m", path.floor, "Least altitude.")
        ->check(number_in(-20000.0, 20000.0));
    command.add_option("--ceiling-m", path.ceiling, "Largest altitude.")
        ->check(number_in(-20000.0, 20000.0));
    command.add_option("--planner", path.planner, "aastar (default) or tangent.")
        ->check(CLI::IsMember({"aastar", "tangent"}));
    command
        .add_option_function<double>(
            "--time-limit-ms", [this](double ms) { path.time_limit = ms / 1000; },
            "End with the best path after so long.")
        ->check(number_in(0.0, 1e9));
    command
        .add_option(
            "--states", path.states,
            "End after so many states were looked at; default 100000, without end "
            "with --time-limit-ms.")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 60));
    command.add_flag("--first", path.first, "End with the first path.");
    add_output(command, path.output);
    command.footer(kPathExamples);
  }

  CLI::App* coverage_command = nullptr;
  PlanCoverageArguments coverage;

  void add_coverage() {
    coverage_command =
        plan->add_subcommand("coverage", "Parallel sweeps over an area, in wind.");
    CLI::App& command = *coverage_command;
    command.add_option("--area", coverage.area, "GeoJSON or KML: the area, with holes.")
        ->required();
    add_starts(command, coverage.starts);
    add_setting(command, coverage.setting);
    add_limits(command, coverage.limits);
    add_zones(command, coverage.maps);
    add_metres(command, coverage.maps);
    command.add_option("--swath-m", coverage.swath, "Width that the sensor sees.")
        ->required()
        ->check(number_in(0.1, 1e5));
    command
        .add_option("--overlap", coverage.overlap,
                    "Share of the swath that neighbours have in common; default 0.")
        ->check(number_in(0.0, 0.95));
    command
        .add_option("--overshoot-m", coverage.overshoot,
                    "Lines begin earlier and end later by so much; default 0.")
        ->check(number_in(0.0, 1e5));
    command
        .add_option("--zone-distance-m", coverage.zone_distance,
                    "Lines keep so far from zones; default 0.")
        ->check(number_in(0.0, 1e5));
    command.add_option("--bearing-deg", coverage.bearing_deg, "Default: the quickest.")
        ->check(number_in(-360.0, 360.0));
    command
        .add_option("--aircraft", coverage.aircraft,
                    "How many; default: as many as there are starts, or 1.")
        ->check(CLI::Range(1, 64));
    command.add_flag("--return", coverage.back, "Each ends where it starts.");
    add_output(command, coverage.output);
    command.footer(kCoverageExamples);
  }

  CLI::App* patrol_command = nullptr;
  PlanPatrolArguments patrol;

  void add_patrol() {
    patrol_command =
        plan->add_subcommand("patrol", "Along a line, there and back or around.");
    CLI::App& command = *patrol_command;
    command
        .add_option("--line", patrol.line,
                    "GeoJSON or KML: the line, or an area whose rim is meant.")
        ->required();
    add_starts(command, patrol.starts);
    add_setting(command, patrol.setting);
    add_limits(command, patrol.limits);
    add_speeds(command, patrol.limits);
    add_checked(command, patrol.maps);
    command.add_flag("--closed", patrol.closed, "Around, instead of there and back.");
    command
        .add_option("--offset-m", patrol.offset,
                    "To the right of the line as it is drawn; negative: left. Default 0.")
        ->check(number_in(-1e5, 1e5));
    command.add_option("--corners", patrol.corners, "rounded (default) or flown-over.")
        ->check(CLI::IsMember({"rounded", "flown-over"}));
    command
        .add_option("--corner-tolerance-m", patrol.corner_tolerance,
                    "Largest distance of line and flight at a corner; default 20.")
        ->check(number_in(0.001, 1e5));
    auto* rounds = command.add_option("--rounds", patrol.rounds, "Default 1.")
                       ->check(CLI::Range(1, 5000));
    command.add_option("--until-s", patrol.until, "As many passes as end by then.")
        ->check(number_in(-1e9, 1e9))
        ->excludes(rounds);
    add_output(command, patrol.output);
    command.footer(kPatrolExamples);
  }

  CLI::App* orbit_command = nullptr;
  PlanOrbitArguments orbit;

  void add_orbit() {
    orbit_command =
        plan->add_subcommand("orbit", "Circles or S-turns over a target that may move.");
    CLI::App& command = *orbit_command;
    command.add_option("--target", orbit.target, "EAST,NORTH in metres, at the start.");
    command.add_option("--target-geo", orbit.target_geo, "LAT,LON, at the start.");
    command.add_option("--target-velocity", orbit.velocity,
                       "EAST,NORTH in m/s; default: it stays.");
    add_starts(command, orbit.starts);
    add_setting(command, orbit.setting);
    add_limits(command, orbit.limits);
    add_speeds(command, orbit.limits);
    add_checked(command, orbit.maps);
    command.add_option("--kind", orbit.kind, "circle (default) or weave: S-turns.")
        ->check(CLI::IsMember({"circle", "weave"}));
    command
        .add_option("--side", orbit.side, "clockwise, anticlockwise or either (default).")
        ->check(CLI::IsMember({"either", "clockwise", "anticlockwise"}));
    command.add_option("--radius-m", orbit.radius, "Of the circle; default 150.")
        ->check(number_in(0.1, 1e6));
    command
        .add_option("--error-m", orbit.error,
                    "Largest error of the distance on the circle; default 1.")
        ->check(number_in(0.001, 1e5));
    command.add_option("--duration-s", orbit.duration, "With the target; default 300.")
        ->check(number_in(0.001, 1e6));
    add_output(command, orbit.output);
    command.footer(kOrbitExamples);
  }

  CLI::App* rendezvous_command = nullptr;
  PlanRendezvousArguments rendezvous;

  void add_rendezvous() {
    rendezvous_command = plan->add_subcommand(
        "rendezvous", "Several aircraft at their goals at one time, or in a row.");
    CLI::App& command = *rendezvous_command;
    add_starts(command, rendezvous.starts);
    add_repeated(command, "--to", rendezvous.to,
                 "EAST,NORTH,HEADING_DEG[,ALTITUDE] in metres; one for each aircraft.");
    add_repeated(command, "--to-geo", rendezvous.to_geo,
                 "LAT,LON,HEADING_DEG[,ALTITUDE].");
    add_setting(command, rendezvous.setting);
    add_limits(command, rendezvous.limits);
    add_speeds(command, rendezvous.limits);
    add_checked(command, rendezvous.maps);
    command
        .add_option("--time-s", rendezvous.time,
                    "Of the first arrival; default: soonest.")
        ->check(number_in(-1e9, 1e9));
    command.add_option("--spacing-s", rendezvous.spacing, "Between arrivals; default 0.")
        ->check(number_in(0.0, 1e6));
    add_output(command, rendezvous.output);
    command.footer(kRendezvousExamples);
  }
};

PlanOptions::PlanOptions(CLI::App& program) : parts_(std::make_unique<Parts>()) {
  parts_->plan = program.add_subcommand("plan", "Plan flights in wind, and write them.");
  parts_->plan->require_subcommand(1);
  parts_->add_connect();
  parts_->add_path();
  parts_->add_coverage();
  parts_->add_patrol();
  parts_->add_orbit();
  parts_->add_rendezvous();
  parts_->plan->footer(
      "\nExamples:\n  skein plan connect --help\n  skein plan path --help");
}

PlanOptions::~PlanOptions() = default;

bool PlanOptions::chosen() const {
  return parts_->plan->parsed();
}

int PlanOptions::run(const std::atomic<bool>& stop) const {
  const Parts& p = *parts_;
  if (*p.path_command) return plan_path_command(p.path, stop);
  if (*p.coverage_command) return plan_coverage_command(p.coverage, stop);
  if (*p.patrol_command) return plan_patrol_command(p.patrol);
  if (*p.orbit_command) return plan_orbit_command(p.orbit);
  if (*p.rendezvous_command) return plan_rendezvous_command(p.rendezvous);
  if (!parts_->connect.batch.empty()) return plan_batch_command(parts_->connect, stop);
  return plan_connect_command(parts_->connect);
}

}  // namespace skein::app
