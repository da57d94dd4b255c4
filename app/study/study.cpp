// SPDX-License-Identifier: Apache-2.0
// `skein study`: a command for each study, with options of its own.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/common/command_options.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/study/parts.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

// --- options that several studies have
// --------------------------------------------------

void add_threads(CLI::App& command, StudyArguments& study) {
  command.add_option("--first-seed", study.first_seed, "The first seed.")
      ->check(CLI::Range(0, 1000000000));
  command.add_option("--threads", study.threads, "Runs at the same time.")
      ->check(CLI::Range(1, 256));
}

void add_seeds(CLI::App& command, StudyArguments& study) {
  command.add_option("--seeds", study.seeds, "Seeds per cell.")
      ->check(CLI::Range(1, 10000));
  add_threads(command, study);
}

void add_only_cases(CLI::App& command, StudyArguments& study) {
  command.add_option("--only-cases", study.cases, "Only these cases (comma separated).")
      ->delimiter(',');
}

void add_methods(CLI::App& command, StudyArguments& study) {
  command.add_option("--estimators", study.estimators, "Only these estimators.")
      ->delimiter(',');
  command.add_option("--strategies", study.strategies, "Only these strategies.")
      ->delimiter(',');
}

// Of studies that fly a shipped scenario.
void add_scenario(CLI::App& command, StudyArguments& study) {
  add_set_option(command, study.overrides);
  add_plugin_option(command, study.plugins);
  add_trust_option(command, study.trusted);
}

// --- the options of each
// ----------------------------------------------------------------

void estimators_options(CLI::App& command, StudyArguments& study) {
  auto* cases =
      command.add_option("--cases", study.cases_file,
                         "Evaluate the rows of this CSV (- = standard input) instead, to "
                         "standard output.");
  auto* updates = command.add_option(
      "--updates", study.updates_file,
      "Whole updates, the rows of this CSV, instead, to standard output.");
  cases->excludes(updates);
  for (CLI::Option* each : {cases, updates}) each->excludes("--out");
}

void monitoring_options(CLI::App& command, StudyArguments& study) {
  add_seeds(command, study);
  add_only_cases(command, study);
  add_methods(command, study);
  add_scenario(command, study);
}

void bridge_options(CLI::App& command, StudyArguments& study) {
  command.add_option("--data", study.data, "Folder of the recorded fire.");
  add_seeds(command, study);
  add_methods(command, study);
  add_scenario(command, study);
}

void flight_options(CLI::App& command, StudyArguments& study) {
  add_seeds(command, study);
  add_only_cases(command, study);
  add_scenario(command, study);
}

void avoidance_options(CLI::App& command, StudyArguments& study) {
  AvoidanceArguments& avoidance = study.avoidance;
  const auto add_word = [&](const char* option, std::string& target, const char* help,
                            std::vector<std::string> words) {
    command.add_option(option, target, help)->check(CLI::IsMember(std::move(words)));
  };
  command.add_option("--cases", study.cases_file, "The cases (CSV).");
  add_only_cases(command, study);
  add_threads(command, study);
  add_word("--method", avoidance.method,
           "none, rule, priority, negotiated, group or auto (default).",
           {"none", "rule", "priority", "negotiated", "group", "auto"});
  add_word("--deal", avoidance.deal,
           "What two agree on: sum (default), product or zeuthen.",
           {"sum", "product", "zeuthen"});
  add_word("--plant", avoidance.plant,
           "path (default), or fixed-wing with six degrees of freedom.",
           {"path", "fixed-wing"});
  command.add_option("--loss", avoidance.loss, "Share of messages lost.")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--delay", avoidance.delay, "Of messages [s].")
      ->check(CLI::Range(0.0, 60.0));
  command
      .add_option("--range", avoidance.range,
                  "Of the radio, and of sensors for intruders [m]; 0: their own.")
      ->check(CLI::Range(0.0, 1e6));
  add_word("--tracks", avoidance.tracks,
           "How intruders are found: perfect (default), adsb, passive or radar.",
           {"perfect", "adsb", "passive", "radar"});
  add_word("--intruder-room", avoidance.room,
           "What is kept free around an intruder: moving (default) or static.",
           {"moving", "static"});
  add_word("--turbulence", avoidance.turbulence,
           "none (default), light, moderate or severe.",
           {"none", "light", "moderate", "severe"});
  add_word("--separation", avoidance.separation,
           "team (50 m, 20 m; default) or light (1500 m, 150 m).", {"team", "light"});
  command
      .add_option("--wind-from", avoidance.wind,
                  "SPEED,DEGREES instead of the wind of the cases.")
      ->delimiter(',')
      ->expected(2);
  command.add_flag("--records", study.records,
                   "Keep the records of every case, for skein report and replay.");
}

void network_options(CLI::App& command, StudyArguments& study) {
  command.add_option("experiment", study.experiment,
                     "grid, cell or hidden: beside ns-3 and Bianchi; mixed or obstacle: "
                     "real and simulated modems.");
  add_seeds(command, study);
  command
      .add_option("--nodes", study.nodes,
                  "Numbers of nodes or stations (comma separated).")
      ->delimiter(',');
  command
      .add_option("--profiles", study.profiles,
                  "Radios by name or file (comma separated).")
      ->delimiter(',');
  command.add_option("--duration", study.duration, "Of each case [s].")
      ->check(CLI::Range(1e-3, 4e6));
}

void tuning_options(CLI::App& command, StudyArguments& study) {
  add_seeds(command, study);
  auto* gains = command
                    .add_option("--gains", study.gains,
                                "Files of gains, beside the scenario's own.")
                    ->delimiter(',');
  command
      .add_option("--search", study.search,
                  "Search for gains, so many tries, from the scenario's own.")
      ->check(CLI::Range(1, 100000))
      ->excludes(gains);
  add_scenario(command, study);
}

// --- the studies
// ------------------------------------------------------------------------

struct StudyKind {
  const char* name;
  const char* help;
  const char* example;  ///< what follows `skein study NAME`
  void (*options)(CLI::App& command, StudyArguments& study);  ///< besides --out, --log
  int (*run)(const StudyArguments& arguments, assemble::KindRegistry& kinds,
             const fs::path& folder, const std::atomic<bool>& stop);
};

constexpr StudyKind kStudies[] = {
    {"estimators", "mean and variance of every measurement update against distance",
     "--cases values.csv > out.csv", estimators_options, estimators_study},
    {"monitoring", "every estimator x strategy x wind case, several seeds",
     "--estimators qkf,joint --strategies gus,tracking-binary --seeds 6",
     monitoring_options, monitoring_study},
    {"bridge", "a real fire, not star-shaped", "--data ../shared/data/fires/bridge_2021",
     bridge_options, bridge_study},
    {"fidelity", "the default mission from kinematic points to aircraft in gusts",
     "--seeds 3", flight_options, fidelity_study},
    {"wind-following",
     "plans made for the wind against plans made without it: how closely they are flown",
     "--seeds 5 --threads 2", flight_options, following_study},
    {"robustness",
     "random wind, turbulence and wrong parameters (1000 runs): is control ever lost?",
     "--seeds 20", flight_options, robustness_study},
    {"ground-starts",
     "starts from the ground in random wind and turbulence (500 runs): is any lost?",
     "--seeds 20", flight_options, ground_starts_study},
    {"keeping", "how closely a glider and a quadrotor track their commands, by receiver",
     "--seeds 5", flight_options, keeping_study},
    {"avoidance",
     "aircraft that will meet, flown to the end: how near they come and what that costs",
     "--cases encounters.csv --method auto --loss 0.2", avoidance_options,
     avoidance_study},
    {"network",
     "the radio medium beside ns-3 and Bianchi: network grid, network cell, network "
     "hidden; real and simulated modems: network mixed, network obstacle",
     "grid --nodes 4,9,16 --profiles nn4,cs91 --seeds 3", network_options, network_study},
    {"tuning", "laps of waypoints, each with other gains; can search for gains",
     "--search 60 --threads 2", tuning_options, tuning_study},
};

std::string names_of_studies() {
  std::string names;
  for (const StudyKind& kind : kStudies) names += fmt::format(" {}", kind.name);
  return names;
}

void print_studies() {
  for (const StudyKind& kind : kStudies) print("{:<15}{}\n", kind.name, kind.help);
}

int run_study(const StudyKind& kind, const StudyArguments& arguments,
              const std::atomic<bool>& stop) {
  fs::path folder = arguments.out;
  if (folder.empty()) {
    std::string name = fmt::format("study-{}", kind.name);
    if (!arguments.experiment.empty()) name += "-" + arguments.experiment;
    folder = fs::path("runs") / name;
  }
  auto kinds = load_kinds(arguments.plugins, arguments.trusted);
  if (!kinds) return kBadUsage;
  return kind.run(arguments, *kinds, folder, stop);
}

}  // namespace

Command add_study(CLI::App& program, const std::atomic<bool>& stop) {
  auto* study = program.add_subcommand("study", "Run a study, with report and summary.");
  study->require_subcommand(0, 1);
  // What is no study gets an answer that names those that there are.
  study->add_option("NAME", "The study; none = list them.")
      ->group("")
      ->check(CLI::Validator(
          [](const std::string& name) {
            return fmt::format("there is no study \"{}\". There are:{}.", name,
                               names_of_studies());
          },
          ""));
  using Chosen = std::pair<const CLI::App*, std::function<int()>>;
  const auto all = std::make_shared<std::vector<Chosen>>();
  for (const StudyKind& kind : kStudies) {
    auto* command = study->add_subcommand(kind.name, kind.help);
    const auto arguments = std::make_shared<StudyArguments>();
    command->add_option("--out", arguments->out,
                        fmt::format("Folder; default: runs/study-{}.", kind.name));
    kind.options(*command, *arguments);
    add_log_option(*command);
    command->footer(
        fmt::format("\nExamples:\n  skein study {} {}", kind.name, kind.example));
    all->emplace_back(
        command, [&kind, arguments, &stop] { return run_study(kind, *arguments, stop); });
  }
  study->footer(R"(
Examples:
  skein study                        list the studies
  skein study monitoring --help      the options of one
  skein study tuning --search 60 --threads 2)");
  return {study, [all]() -> int {
            for (const auto& [command, run] : *all)
              if (*command) return run();
            print_studies();
            return kDone;
          }};
}

}  // namespace skein::app
