#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <map>
#include <new>
#include <sstream>
#include <string>

#include "app/commands.h"
#include "app/number_range.h"
#include "app/output.h"
#include "app/plan_options.h"
#include "app/version.h"
#include "skein/base/log.h"
#include "skein/base/result.h"

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
  skein run --replay runs/six                           the same again)";

constexpr const char* kCheckExamples = R"(
Examples:
  skein check scenarios/wildfire.yaml
  skein check scenarios/wildfire.yaml --set monitoring.estimator=ensemble
  skein check scenarios/wildfire.yaml --print > full.yaml     with all defaults)";

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

constexpr const char* kReportExamples = R"(
Examples:
  skein report runs/wildfire                              writes runs/wildfire/report.html
  skein report runs/gus runs/sweep --out comparison.html  side by side)";

constexpr const char* kCompletionExamples = R"(
Examples:
  source <(skein completion)
  source <(skein completion zsh))";

constexpr const char* kStudyExamples = R"(
Studies:
  estimators   mean and variance of every measurement update against distance
  monitoring   every estimator x strategy x wind case, several seeds
  bridge       a real fire, not star-shaped
  fidelity     the default mission from kinematic points to aircraft in gusts
  tuning       laps of waypoints, each with other gains; can search for gains

Examples:
  skein study estimators
  skein study monitoring --estimators qkf,joint --strategies gus,tracking-binary --seeds 6
  skein study bridge --data ../shared/data/fires/bridge_2021
  skein study tuning --search 60 --threads 2
  skein study estimators --cases values.csv > out.csv)";

// The option `--log` of a command.
void add_log_option(CLI::App& command) {
  using skein::LogLevel;
  static const std::map<std::string, LogLevel> kLevels = {{"debug", LogLevel::kDebug},
                                                          {"info", LogLevel::kInfo},
                                                          {"warning", LogLevel::kWarning},
                                                          {"error", LogLevel::kError}};
  command
      .add_option_function<std::string>(
          "--log",
          [](const std::string& level) { skein::set_log_level(kLevels.at(level)); },
          "Say on standard error what happens: debug, info (events), warning, error.")
      ->check(CLI::IsMember({"debug", "info", "warning", "error"}))
      ->type_name("LEVEL");
}

// The option `--plugin` of a command.
void add_plugin_option(CLI::App& command, std::vector<std::string>& plugins) {
  command
      .add_option("--plugin", plugins,
                  "A shared library with kinds of your own; may be repeated.")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false);
}

int run_program(int argc, char** argv) {
  using namespace skein::app;
  CLI::App app{"Skein: teams of unmanned aircraft in mixed reality."};
  app.require_subcommand(1);
  app.set_version_flag("--version", skein::app::kVersion);
  app.failure_message(CLI::FailureMessage::simple);

  RunArguments run;
  auto* run_cmd = app.add_subcommand("run", "Run a scenario.");
  auto* run_scenario =
      run_cmd->add_option("scenario", run.scenario, "The scenario file (YAML).");
  run_cmd->add_option("--out", run.out, "Folder for the run; default: runs/NAME.");
  run_cmd->add_option("--seed", run.seed, "Seed instead of the scenario's.");
  run_cmd->add_option("--speed", run.speed, "fast, real, or a factor of real time.");
  run_cmd
      ->add_option("--set", run.overrides, "KEY=VALUE: overrides a key of the scenario.")
      ->take_all()
      ->allow_extra_args(false);
  add_plugin_option(*run_cmd, run.plugins);
  run_cmd->add_option("--threads", run.threads, "Threads of the simulation.")
      ->check(CLI::Range(1, 256));
  run_cmd->add_flag("--commands", run.commands,
                    "Take commands from standard input, line by line; see "
                    "docs/commands.md.");
  run_cmd
      ->add_option(
          "--replay", run.replay,
          "Folder of a run that is done again, with the commands that were given "
          "in it; says whether the content hash is the same.")
      ->excludes(run_scenario)
      ->excludes("--commands");
  run_cmd->add_flag("--report", run.report, "Write report.html at the end.");
  run_cmd->add_flag("--json", run.json, "Print the summary as JSON on standard output.");
  run_cmd->add_flag("--overwrite", run.overwrite, "Replace a run that is in the folder.");
  add_log_option(*run_cmd);
  run_cmd->footer(kRunExamples);

  std::string scenario;
  std::vector<std::string> overrides;
  std::vector<std::string> plugins;
  bool filled_in = false;
  auto* check_cmd =
      app.add_subcommand("check", "Check a scenario: all problems at once.");
  check_cmd->add_option("scenario", scenario, "The scenario file (YAML).")->required();
  check_cmd->add_option("--set", overrides, "KEY=VALUE: overrides a key of the scenario.")
      ->take_all()
      ->allow_extra_args(false);
  add_plugin_option(*check_cmd, plugins);
  check_cmd->add_flag("--print", filled_in,
                      "Print the scenario with all defaults filled in.");
  add_log_option(*check_cmd);
  check_cmd->footer(kCheckExamples);

  std::string role;
  auto* list_cmd = app.add_subcommand("list", "List the kinds that a scenario can name.");
  list_cmd->add_option("kind", role, "Only this role: estimator, strategy, fire...");
  add_plugin_option(*list_cmd, plugins);
  bool verify = false;
  list_cmd->add_flag("--verify", verify,
                     "Test whether kinds keep the contract of their role: those of the "
                     "plugins; without plugins all.");
  list_cmd->footer(kListExamples);

  auto* schema_cmd = app.add_subcommand(
      "schema", "Print the JSON Schema of scenario or aircraft files, for editors.");
  schema_cmd->footer(kSchemaExamples);
  auto* keys_cmd =
      app.add_subcommand("keys", "Print the documentation of all keys (Markdown).");
  std::string document = "scenario";
  for (auto* command : {schema_cmd, keys_cmd}) {
    command
        ->add_option("of", document,
                     "Of which files: scenario or aircraft; records: what runs leave "
                     "behind.")
        ->check(CLI::IsMember({"scenario", "aircraft", "records"}));
    add_plugin_option(*command, plugins);
  }
  keys_cmd->footer(kKeysExamples);

  FlyArguments fly;
  TrimArguments trim;
  bool steady = false;
  auto* fly_cmd = app.add_subcommand(
      "fly", "Fly one fixed wing alone, open loop, from a table; or find its trims.");
  fly_cmd
      ->add_option("--aircraft", fly.aircraft,
                   "A built-in aircraft (skein list aircraft) or an aircraft file.")
      ->required();
  auto* fly_input = fly_cmd->add_option(
      "--input", fly.input, "CSV of deflections, thrust and wind; - = standard input.");
  auto* fly_output = fly_cmd->add_option(
      "--output", fly.output, "CSV of the motion; - = standard output, the default.");
  auto* fly_step = fly_cmd
                       ->add_option("--step", fly.step,
                                    "Longest integration step in seconds; default 0.005.")
                       ->check(number_in(1e-6, 1.0));
  auto* fly_planet = fly_cmd
                         ->add_option("--planet-radius", fly.planet_radius,
                                      "Gravity falls off as on a sphere of so many "
                                      "metres; 0: not at all; default 637100000.")
                         ->check(number_in(0.0, 1e15));
  auto* fly_trim = fly_cmd->add_flag("--trim", steady, "Find steady flights instead.");
  std::vector<CLI::Option*> of_trim = {
      fly_cmd
          ->add_option("--airspeed", trim.airspeed,
                       "m/s; without it, all over the aircraft's range.")
          ->check(number_in(0.1, 500.0)),
      fly_cmd->add_option("--climb-deg", trim.climb_deg, "Climb angle through the air.")
          ->check(number_in(-85.0, 85.0)),
      fly_cmd->add_option("--altitude", trim.altitude, "Metres above mean sea level.")
          ->check(number_in(-5000.0, 20000.0)),
      fly_cmd
          ->add_option("--hold", trim.hold,
                       "Print an input table that holds it for so many seconds.")
          ->check(number_in(0.001, 1e6)),
      fly_cmd->add_flag("--json", trim.json, "Print as JSON.")};
  auto* fly_radius = fly_cmd
                         ->add_option("--turn-radius", trim.turn_radius,
                                      "Metres; negative: to the left.")
                         ->check(number_in(-1e6, 1e6));
  auto* fly_bank =
      fly_cmd->add_option("--bank-deg", trim.bank_deg, "Of the turn; negative: left.")
          ->check(number_in(-85.0, 85.0))
          ->excludes(fly_radius);
  of_trim.insert(of_trim.end(), {fly_radius, fly_bank});
  for (CLI::Option* option : of_trim) option->needs(fly_trim);
  for (CLI::Option* option : {fly_input, fly_output, fly_step, fly_planet})
    fly_trim->excludes(option);
  fly_cmd->footer(kFlyExamples);

  const PlanOptions plan(app);

  std::vector<std::filesystem::path> runs;
  std::filesystem::path report_out;
  auto* report_cmd =
      app.add_subcommand("report", "Write an HTML report of one or more runs.");
  report_cmd->add_option("run", runs, "Folders of runs.")->required();
  report_cmd->add_option("--out", report_out, "The HTML file; default: RUN/report.html.");
  report_cmd->footer(kReportExamples);

  StudyArguments study;
  auto* study_cmd = app.add_subcommand("study", "Run a study, with report and summary.");
  study_cmd->add_option("name", study.name, "The study; none = list them.");
  study_cmd->add_option("--out", study.out, "Folder; default: runs/study-NAME.");
  study_cmd->add_option("--seeds", study.seeds, "Seeds per cell.")
      ->check(CLI::Range(1, 10000));
  study_cmd->add_option("--first-seed", study.first_seed, "The first seed.")
      ->check(CLI::Range(0, 1000000000));
  study_cmd->add_option("--threads", study.threads, "Runs at the same time.")
      ->check(CLI::Range(1, 256));
  for (const auto& [option, target, help] :
       {std::tuple{"--only-cases", &study.cases, "Only these cases (comma separated)."},
        std::tuple{"--estimators", &study.estimators, "Only these estimators."},
        std::tuple{"--strategies", &study.strategies, "Only these strategies."}})
    study_cmd->add_option(option, *target, help)->delimiter(',');
  study_cmd->add_option("--set", study.overrides, "KEY=VALUE for every run.")
      ->take_all()
      ->allow_extra_args(false);
  add_plugin_option(*study_cmd, study.plugins);
  study_cmd->add_option(
      "--cases", study.cases_file,
      "estimators: evaluate the rows of this CSV (- = standard input).");
  study_cmd->add_option("--updates", study.updates_file,
                        "estimators: whole updates, rows of this CSV.");
  study_cmd->add_option("--data", study.data, "bridge: folder of the recorded fire.");
  study_cmd
      ->add_option("--gains", study.gains,
                   "tuning: files of gains, beside the scenario's own.")
      ->delimiter(',');
  study_cmd
      ->add_option("--search", study.search, "tuning: search for gains, so many tries.")
      ->check(CLI::Range(1, 100000));
  add_log_option(*study_cmd);
  study_cmd->footer(kStudyExamples);

  std::string shell = "bash";
  auto* completion_cmd = app.add_subcommand(
      "completion", "Print shell completion: source <(skein completion)");
  completion_cmd->add_option("shell", shell, "bash or zsh.")
      ->check(CLI::IsMember({"bash", "zsh"}));
  completion_cmd->footer(kCompletionExamples);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    const int status = app.exit(error, out, err);
    put_out(out.str());
    put_err(err.str());
    return status == 0 ? kDone : kBadUsage;
  }

  for (const CLI::Option* option : study_cmd->get_options())
    if (option->count() > 0) study.given.push_back(option->get_name());

  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (*run_cmd) return run_command(run, stop_requested);
  if (*check_cmd) return check_command(scenario, overrides, plugins, filled_in);
  if (*list_cmd && verify) return verify_command(role, plugins);
  if (*list_cmd) return list_command(role, plugins);
  if (*schema_cmd) return schema_command(document, plugins);
  if (*keys_cmd) return keys_command(document, plugins);
  if (*fly_cmd && steady) {
    trim.aircraft = fly.aircraft;
    return trim_command(trim);
  }
  if (*fly_cmd) return fly_command(fly, stop_requested);
  if (plan.chosen()) return plan.run(stop_requested);
  if (*report_cmd) return report_command(runs, report_out);
  if (*study_cmd) return study_command(study, stop_requested);
  return completion_command(shell);
}

// Nothing that goes wrong ends in std::terminate: every error has a message and a status.
int run_guarded(int argc, char** argv) {
  using namespace skein::app;
  try {
    return run_program(argc, argv);
  } catch (const std::bad_alloc&) {
    put_err(
        "error: not enough memory. Use a coarser grid or fewer members, or run fewer "
        "at a time.\n");
  } catch (const std::filesystem::filesystem_error& error) {
    complain("error: {}: {}.\n", error.path1().string(), error.code().message());
  } catch (const std::exception& error) {
    complain("error: {}\n", skein::internal_error(error.what()).text());
  }
  return kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  return skein::app::finish_output(run_guarded(argc, argv));
}
