// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "app/avoid/commands.h"
#include "app/common/command_options.h"
#include "app/common/commands.h"
#include "app/common/number_range.h"
#include "app/common/output.h"
#include "app/common/version.h"
#include "app/plan/options.h"
#include "app/team/commands.h"
#include "skein/base/result.h"
#include "skein/record/store/sqlite.h"

namespace skein::app {
namespace {

std::atomic<bool> stop_requested{false};

extern "C" void on_signal(int signal) {
  stop_requested = true;
  std::signal(signal, SIG_DFL);  // a second Ctrl-C ends the program at once
}

constexpr const char* kRunExamples = R"(
Examples:
  skein run scenarios/wildfire.yaml --report
  skein run scenarios/wildfire.yaml --seed 7 --set aircraft[0].count=6 --out runs/six
  skein run scenarios/wildfire.yaml --speed 10          ten times real time
  skein run scenarios/wildfire.yaml --serve             with the operator's page
  skein run --replay runs/six                           the same again)";

constexpr const char* kCheckExamples = R"(
Examples:
  skein check scenarios/wildfire.yaml
  skein check scenarios/wildfire.yaml --set missions[0].estimator=ensemble
  skein check scenarios/wildfire.yaml --print > full.yaml     with all defaults
  skein check --update mine/*.yaml      after a new version: its names for keys)";

constexpr const char* kListExamples = R"(
Examples:
  skein list                all kinds of all roles
  skein list estimator      those of one role
  skein list aircraft       the aircraft that are part of the program
  skein list --verify --plugin my_kinds.so      test the kinds of a plugin)";

constexpr const char* kSchemaExamples = R"(
Examples:
  skein schema > scenario.schema.json
  skein schema aircraft > aircraft.schema.json
  skein schema records      TypeScript types of records, messages and commands
  skein schema wire         a table of how the live feed lies in its bytes
  then, in the first line of a scenario, for editors with a YAML language server:
  # yaml-language-server: $schema=scenario.schema.json)";

constexpr const char* kKeysExamples = R"(
Examples:
  skein keys > scenario-keys.md
  skein keys aircraft > aircraft-keys.md)";

constexpr const char* kFlyExamples = R"(
Examples:
  skein fly --trim --aircraft aerosonde                    steady flights, all speeds
  skein fly --trim --aircraft aerosonde --airspeed 25 --hold 60 > in.csv
  skein fly --aircraft aerosonde --input in.csv --output out.csv)";

constexpr const char* kExportExamples = R"(
Examples:
  skein export runs/wildfire --what perimeter --out perimeter.geojson
  skein export runs/wildfire --what prediction --at 1800 --out ahead.gpkg
  skein export runs/now --what bands --out bands.kml --every 60   renewed while it runs)";

constexpr const char* kFireExamples = R"(
Examples:
  skein fire perimeters.geojson --incident "Bridge" --scenario bridge.yaml
  skein fire IncidentFolder --utc-offset-h -7 --out perimeters.gpkg)";

constexpr const char* kReportExamples = R"(
Examples:
  skein report runs/wildfire                              writes runs/wildfire/report.html
  skein report runs/gus runs/sweep --out comparison.html  side by side)";

constexpr const char* kCompletionExamples = R"(
Examples:
  source <(skein completion)
  source <(skein completion zsh))";

constexpr const char* kCampaignExamples = R"(
Examples:
  skein campaign campaigns/formation.yaml
  skein campaign campaigns/surveys.yaml --first-seed 1001 --seeds 20
  skein campaign campaigns/tracking.yaml --only aerosonde --set duration_s=300 --out runs/a
What is finished is kept: the same command again goes on where it was.)";

Command add_run(CLI::App& program) {
  auto* command = program.add_subcommand("run", "Run a scenario.");
  const auto run = std::make_shared<RunArguments>();
  auto* scenario =
      command->add_option("scenario", run->scenario, "The scenario file (YAML).");
  command->add_option("--out", run->out, "Folder for the run; default: runs/NAME.");
  command->add_option("--seed", run->seed, "Seed instead of the scenario's.");
  command->add_option("--speed", run->speed, "fast, real, or a factor of real time.");
  add_set_option(*command, run->overrides);
  add_plugin_option(*command, run->plugins);
  add_trust_option(*command, run->trusted);
  command->add_option("--threads", run->threads, "Threads of the simulation.")
      ->check(CLI::Range(1, 256));
  command->add_flag("--commands", run->commands,
                    "Take commands from standard input, line by line; see "
                    "docs/commands.md.");
  command
      ->add_option(
          "--replay", run->replay,
          "Folder of a run that is done again, with the commands that were given "
          "in it; says whether the content hash is the same.")
      ->excludes(scenario)
      ->excludes("--commands");
  add_serve_options(*command, run->serve, run->page);
  command->add_flag("--report", run->report, "Write report.html at the end.");
  command->add_flag("--json", run->json, "Print the summary as JSON on standard output.");
  command->add_flag("--overwrite", run->overwrite,
                    "Replace a run that is in the folder.");
  add_log_option(*command);
  command->footer(kRunExamples);

  return {command, [run] { return run_command(*run, stop_requested); }};
}

Command add_check(CLI::App& program) {
  auto* command = program.add_subcommand(
      "check", "Check scenarios and other files: all problems at once.");
  const auto check = std::make_shared<CheckArguments>();
  command
      ->add_option("files", check->files,
                   "Scenarios, aircraft, radios, relays or campaigns (YAML).")
      ->required();
  add_set_option(*command, check->overrides);
  add_plugin_option(*command, check->plugins);
  add_trust_option(*command, check->trusted);
  command->add_flag("--print", check->filled_in,
                    "Print the scenario with all defaults filled in.");
  command->add_flag("--update", check->update,
                    "First rewrite names of former versions in the files, and show what "
                    "has changed; comments stay.");
  add_log_option(*command);
  command->footer(kCheckExamples);
  return {command, [check] { return check_command(*check); }};
}

Command add_list(CLI::App& program) {
  struct Given {
    std::string role;
    std::vector<std::string> plugins;
    bool verify = false;
  };
  auto* command =
      program.add_subcommand("list", "List the kinds that a scenario can name.");
  const auto given = std::make_shared<Given>();
  command->add_option("kind", given->role,
                      "Only this role: estimator, strategy, fire...");
  add_plugin_option(*command, given->plugins);
  command->add_flag("--verify", given->verify,
                    "Test whether kinds keep the contract of their role: those of the "
                    "plugins; without plugins all.");
  command->footer(kListExamples);
  return {command, [given] {
            return (given->verify ? verify_command : list_command)(given->role,
                                                                   given->plugins);
          }};
}

// `schema` and `keys` describe the same documents.
Command add_description(CLI::App& program, const char* name, const char* help,
                        const char* examples,
                        int (*describe)(const std::string& document,
                                        const std::vector<std::string>& plugins)) {
  struct Given {
    std::string document = "scenario";
    std::vector<std::string> plugins;
  };
  auto* command = program.add_subcommand(name, help);
  const auto given = std::make_shared<Given>();
  std::vector<std::string> documents = {"scenario", "aircraft", "radio",
                                        "relay",    "campaign", "records"};
  std::string which =
      "Of which files: scenario, aircraft, radio, relay or campaign; records: what runs "
      "leave "
      "behind";
  if (std::string_view(name) == "keys") {
    documents.insert(documents.end(), {"tasks", "events"});
    which += "; tasks: how orders are written; events: kinds of events";
  } else {
    documents.emplace_back("wire");
    which += "; wire: how the live feed is coded";
  }
  command->add_option("of", given->document, which + ".")
      ->check(CLI::IsMember(documents));
  add_plugin_option(*command, given->plugins);
  command->footer(examples);
  return {command,
          [given, describe] { return describe(given->document, given->plugins); }};
}

// The options of `fly --trim`.
std::vector<CLI::Option*> add_trim(CLI::App& command, TrimArguments& trim) {
  std::vector<CLI::Option*> options = {
      command
          .add_option("--airspeed", trim.airspeed,
                      "m/s; without it, all over the aircraft's range.")
          ->check(number_in(0.1, 500.0)),
      command.add_option("--climb-deg", trim.climb_deg, "Climb angle through the air.")
          ->check(number_in(-85.0, 85.0)),
      command.add_option("--altitude", trim.altitude, "Metres above mean sea level.")
          ->check(number_in(-5000.0, 20000.0)),
      command
          .add_option("--hold", trim.hold,
                      "Print an input table that holds it for so many seconds.")
          ->check(number_in(0.001, 1e6)),
      command.add_flag("--json", trim.json, "Print as JSON.")};
  auto* radius =
      command
          .add_option("--turn-radius", trim.turn_radius, "Metres; negative: to the left.")
          ->check(number_in(-1e6, 1e6));
  auto* bank =
      command.add_option("--bank-deg", trim.bank_deg, "Of the turn; negative: left.")
          ->check(number_in(-85.0, 85.0))
          ->excludes(radius);
  options.insert(options.end(), {radius, bank});
  return options;
}

Command add_fly(CLI::App& program) {
  struct Given {
    FlyArguments fly;
    TrimArguments trim;
    bool steady = false;
  };
  auto* command = program.add_subcommand(
      "fly", "Fly one fixed wing alone, open loop, from a table; or find its trims.");
  const auto given = std::make_shared<Given>();
  FlyArguments& fly = given->fly;
  command
      ->add_option("--aircraft", fly.aircraft,
                   "A built-in aircraft (skein list aircraft) or an aircraft file.")
      ->required();
  auto* input = command->add_option(
      "--input", fly.input, "CSV of deflections, thrust and wind; - = standard input.");
  auto* output = command->add_option(
      "--output", fly.output, "CSV of the motion; - = standard output, the default.");
  auto* step = command
                   ->add_option("--step", fly.step,
                                "Longest integration step in seconds; default 0.005.")
                   ->check(number_in(1e-6, 1.0));
  auto* planet = command
                     ->add_option("--planet-radius", fly.planet_radius,
                                  "Gravity falls off as on a sphere of so many "
                                  "metres; 0: not at all; default 637100000.")
                     ->check(number_in(0.0, 1e15));
  auto* steady =
      command->add_flag("--trim", given->steady, "Find steady flights instead.");
  for (CLI::Option* option : add_trim(*command, given->trim)) option->needs(steady);
  for (CLI::Option* option : {input, output, step, planet}) steady->excludes(option);
  command->footer(kFlyExamples);
  return {command, [given] {
            if (!given->steady) return fly_command(given->fly, stop_requested);
            given->trim.aircraft = given->fly.aircraft;
            return trim_command(given->trim);
          }};
}

Command add_report(CLI::App& program) {
  struct Given {
    std::vector<std::filesystem::path> runs;
    std::filesystem::path out;
  };
  auto* command =
      program.add_subcommand("report", "Write an HTML report of one or more runs.");
  const auto given = std::make_shared<Given>();
  command->add_option("run", given->runs, "Folders of runs.")->required();
  command->add_option("--out", given->out, "The HTML file; default: RUN/report.html.");
  command->footer(kReportExamples);
  return {command, [given] { return report_command(given->runs, given->out); }};
}

Command add_export(CLI::App& program) {
  const auto given = std::make_shared<ExportArguments>();
  auto* command = program.add_subcommand(
      "export", "Write what a run knows as a map for geographic information systems.");
  command->add_option("run", given->run, "Folder of the run, finished or going on.")
      ->required();
  command
      ->add_option("--what", given->what,
                   "perimeter, bands (where it burns with 2.5 to 97.5 %), prediction, "
                   "tracks or zones.")
      ->required()
      ->check(CLI::IsMember({"perimeter", "bands", "prediction", "tracks", "zones"}));
  command->add_option("--at", given->at, "Simulated time in seconds; default: the last.")
      ->check(number_in(0, 4e6));
  command
      ->add_option("--out", given->out,
                   "The file: .geojson, .kml, .gpkg (GeoPackage) or .shp (shapefile).")
      ->required();
  command
      ->add_option("--every", given->every,
                   "Write it again after so many seconds, until the run has ended.")
      ->check(CLI::Range(1.0, 86400.0));
  command->footer(kExportExamples);
  return {command, [given] { return export_command(*given, stop_requested); }};
}

Command add_fire(CLI::App& program) {
  const auto given = std::make_shared<FireArguments>();
  auto* command = program.add_subcommand(
      "fire", "Read a recorded fire as agencies publish it: what it holds, a scenario.");
  command
      ->add_option("source", given->source,
                   "File (GeoJSON, shapefile, also zipped, KML, KMZ, GeoPackage, file "
                   "geodatabase, table, arrival-time raster) or folder of such files.")
      ->required();
  command->add_option("--incident", given->incident,
                      "The fire, if the source holds several.");
  command->add_option("--time-field", given->time_field,
                      "Attribute with the times; default: it is looked for.");
  command
      ->add_option("--utc-offset-h", given->utc_offset_h,
                   "Local time minus UTC, of times without a zone.")
      ->check(CLI::Range(-14.0, 14.0));
  command
      ->add_option("--date-order", given->date_order,
                   "What stands first in dates such as 5/9/2021; default: as the dates "
                   "show.")
      ->check(CLI::IsMember({"month-first", "day-first", "year-first"}));
  command->add_option("--scenario", given->scenario,
                      "Write a scenario that flies two aircraft there (YAML).");
  command->add_option("--out", given->out,
                      "Write the perimeters as read: .geojson, .kml, .gpkg or .shp.");
  command->footer(kFireExamples);
  return {command, [given] { return fire_command(*given); }};
}

Command add_campaign(CLI::App& program) {
  auto* command = program.add_subcommand(
      "campaign",
      "Fly a scenario in every combination of variants, with report and summary.");
  const auto given = std::make_shared<CampaignArguments>();
  command->add_option("file", given->file, "The campaign (YAML).")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--out", given->out, "Folder; default: runs/campaign-NAME.");
  command->add_option("--seeds", given->seeds, "Runs of every combination.")
      ->check(CLI::Range(1, 10000));
  command->add_option("--first-seed", given->first_seed, "The first seed.")
      ->check(CLI::Range(0, 1000000000));
  command->add_option("--threads", given->threads, "Runs at the same time.")
      ->check(CLI::Range(1, 256));
  command
      ->add_option("--only", given->only,
                   "Only these variants (comma separated); of an axis without any, all.")
      ->delimiter(',');
  command->add_option("--set", given->overrides, "KEY=VALUE for every run.")
      ->take_all()
      ->allow_extra_args(false);
  command->add_flag("--scenarios", given->scenarios,
                    "Write the scenario of every run, to fly one again with records.");
  add_plugin_option(*command, given->plugins);
  add_trust_option(*command, given->trusted);
  add_log_option(*command);
  command->footer(kCampaignExamples);
  return {command, [given] { return campaign_command(*given, stop_requested); }};
}

Command add_completion(CLI::App& program) {
  auto* command = program.add_subcommand(
      "completion", "Print shell completion: source <(skein completion)");
  const auto shell = std::make_shared<std::string>("bash");
  command->add_option("shell", *shell, "bash or zsh.")
      ->check(CLI::IsMember({"bash", "zsh"}));
  command->footer(kCompletionExamples);
  return {command, [shell] { return completion_command(*shell); }};
}

int run_program(int argc, char** argv) {
  CLI::App program{"Skein: teams of unmanned aircraft in mixed reality."};
  program.require_subcommand(1);
  program.set_version_flag("--version", kVersion);
  program.failure_message(CLI::FailureMessage::simple);
  std::vector<Command> commands;
  for (auto* add : {add_run, add_check, add_list}) commands.push_back(add(program));
  commands.push_back(
      add_description(program, "schema",
                      "Print the JSON Schema of scenario, aircraft, radio, "
                      "relay or campaign files, for editors.",
                      kSchemaExamples, schema_command));
  commands.push_back(add_description(program, "keys",
                                     "Print the documentation of all keys (Markdown).",
                                     kKeysExamples, keys_command));
  commands.push_back(add_fly(program));
  const PlanOptions plan(program);
  for (auto* add : {add_avoid, add_report, add_export, add_fire})
    commands.push_back(add(program));
  for (auto* add : {add_replay, add_link, add_relay, add_vehicle, add_agent, add_team,
                    add_net, add_study})
    commands.push_back(add(program, stop_requested));
  for (auto* add : {add_campaign, add_completion}) commands.push_back(add(program));

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    const int status = program.exit(error, out, err);
    put_out(out.str());
    put_err(err.str());
    return status == 0 ? kDone : kBadUsage;
  }

  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  record::stop_reading_when(&stop_requested);
  if (plan.chosen()) return plan.run(stop_requested);
  for (const Command& command : commands)
    if (*command.app) return command.run();
  return kBadUsage;
}

// Nothing that goes wrong ends in std::terminate: every error has a message and a status.
int run_guarded(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::bad_alloc&) {
    put_err(
        "error: not enough memory. Use a coarser grid or fewer members, or run fewer "
        "at a time.\n");
  } catch (const std::filesystem::filesystem_error& error) {
    complain("error: {}: {}.\n", error.path1().string(), error.code().message());
  } catch (const std::exception& error) {
    complain("error: {}\n", internal_error(error.what()).text());
  }
  return kFailed;
}

}  // namespace
}  // namespace skein::app

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  return skein::app::finish_output(skein::app::run_guarded(argc, argv));
}
