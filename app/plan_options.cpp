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
                    "A flight of so many seconds instead of the quickest.")
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
};

PlanOptions::PlanOptions(CLI::App& program) : parts_(std::make_unique<Parts>()) {
  parts_->plan = program.add_subcommand("plan", "Plan flights in wind, and write them.");
  parts_->plan->require_subcommand(1);
  parts_->add_connect();
  parts_->plan->footer("\nExamples:\n  skein plan connect --help");
}

PlanOptions::~PlanOptions() = default;

bool PlanOptions::chosen() const {
  return parts_->plan->parsed();
}

int PlanOptions::run(const std::atomic<bool>& stop) const {
  if (!parts_->connect.batch.empty()) return plan_batch_command(parts_->connect, stop);
  return plan_connect_command(parts_->connect);
}

}  // namespace skein::app
