// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/version.h"
#include "app/study/particle_update.h"
#include "app/study/parts.h"
#include "skein/assemble/world/recorded_scenario.h"
#include "skein/assemble/world/run.h"
#include "skein/base/input_file.h"
#include "skein/base/log.h"
#include "skein/base/output_file.h"
#include "skein/campaign/batch/study_summary.h"
#include "skein/campaign/bridge/bridge_study.h"
#include "skein/campaign/estimators/estimators_csv.h"
#include "skein/campaign/estimators/estimators_report.h"
#include "skein/campaign/estimators/estimators_study.h"
#include "skein/campaign/fidelity/fidelity_study.h"
#include "skein/campaign/monitoring/monitoring_report.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/campaign/robustness/robustness_study.h"
#include "skein/record/report/study_report.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

// --- estimators ---------------------------------------------------------------------

int evaluate_rows(const std::string& file,
                  std::vector<Error> (*evaluate)(std::istream&, const std::string&,
                                                 std::ostream&)) {
  std::ifstream stored;
  if (file != "-") {
    auto opened = open_input(file);
    if (!opened) return say_error(opened.error());
    stored = std::move(opened).value();
  }
  const auto problems =
      evaluate(file == "-" ? std::cin : stored, file == "-" ? "stdin" : file, std::cout);
  for (const Error& problem : problems) complain("{}\n", problem.text());
  return problems.empty() ? kDone : kBadUsage;
}

int estimators(const fs::path& folder) {
  if (auto made = make_folder(folder); !made) return say_error(made.error());
  campaign::EstimatorsStudyOptions options;
  options.more = {{"particle", particle_update}};
  const auto tables = campaign::estimators_study(options);
  for (const campaign::CurveTable& table : tables) {
    std::ostringstream csv;
    campaign::write_csv(table, csv);
    if (auto written = write_file(folder / (table.name + ".csv"), csv.str()); !written)
      return say_error(written.error());
  }
  if (auto written = record::write_study_report(
          campaign::estimators_report(tables, options.sigma), folder / "report.html");
      !written)
    return say_error(written.error());
  if (auto written = campaign::write_study_summary(
          "estimators", kVersion, "complete", campaign::study_figures(tables), folder);
      !written)
    return say_error(written.error());
  print("Written: {}  summary.json  and one CSV per figure\n",
        (folder / "report.html").string());
  return kDone;
}

// --- studies of many runs -----------------------------------------------------------

int monitoring(const StudyArguments& arguments, assemble::KindRegistry& kinds,
               const fs::path& folder, const std::atomic<bool>& stop) {
  campaign::MonitoringStudy study;
  take_arguments(arguments, "thesis-no-wind.yaml", study);
  study.cases = arguments.cases;
  study.estimators = arguments.estimators;
  study.strategies = arguments.strategies;
  const auto plan =
      campaign::plan_monitoring_study(study, reader_of(kinds, arguments.plugins));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop);
  if (!outcomes) return say_error(outcomes.error());
  return finish("monitoring", plan.value(), outcomes.value(),
                campaign::monitoring_report(study, plan.value(), outcomes.value()),
                folder, stop);
}

int bridge(const StudyArguments& arguments, assemble::KindRegistry& kinds,
           const fs::path& folder, const std::atomic<bool>& stop) {
  campaign::BridgeStudy study;
  take_arguments(arguments, "bridge-fire.yaml", study);
  study.estimators = arguments.estimators;
  study.strategies = arguments.strategies;
  if (!arguments.data.empty()) {
    const auto recorded = assemble::read_recorded_scenario(arguments.data, {});
    if (!recorded) return say_error(recorded.error());
    const auto fitted = assemble::recorded_overrides(recorded.value());
    // What the command line says comes after what was fitted.
    study.overrides.insert(study.overrides.begin(), fitted.begin(), fitted.end());
  }
  const auto plan =
      campaign::plan_bridge_study(study, reader_of(kinds, arguments.plugins));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop);
  if (!outcomes) return say_error(outcomes.error());
  return finish("bridge", plan.value(), outcomes.value(),
                campaign::bridge_report(study, plan.value(), outcomes.value()), folder,
                stop);
}

int fidelity(const StudyArguments& arguments, assemble::KindRegistry& kinds,
             const fs::path& folder, const std::atomic<bool>& stop) {
  campaign::FidelityStudy study;
  take_arguments(arguments, "wildfire.yaml", study);
  study.levels = arguments.cases;
  const auto plan =
      campaign::plan_fidelity_study(study, reader_of(kinds, arguments.plugins));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop);
  if (!outcomes) return say_error(outcomes.error());
  return finish("fidelity", plan.value(), outcomes.value(),
                campaign::fidelity_report(study, plan.value(), outcomes.value()), folder,
                stop);
}

int robustness(const StudyArguments& arguments, assemble::KindRegistry& kinds,
               const fs::path& folder, const std::atomic<bool>& stop) {
  campaign::RobustnessStudy study;
  take_arguments(arguments, "robustness.yaml", study);
  study.aircraft = arguments.cases;
  const auto plan =
      campaign::plan_robustness_study(study, reader_of(kinds, arguments.plugins));
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments.threads, kinds, folder, stop,
                                 [&](const campaign::BatchItem& item) {
                                   campaign::FlightWatch watch = campaign::watch_of(item);
                                   auto summary = run_item(item, kinds, stop, &watch);
                                   if (summary)
                                     watch.add_figures(summary.value().numbers);
                                   return summary;
                                 });
  if (!outcomes) return say_error(outcomes.error());
  return finish("robustness", plan.value(), outcomes.value(),
                campaign::robustness_report(plan.value(), outcomes.value()), folder,
                stop);
}

struct StudyKind {
  const char* name;
  const char* help;
  std::vector<std::string> options;  // that it takes
  int (*run)(const StudyArguments& arguments, assemble::KindRegistry& kinds,
             const fs::path& folder, const std::atomic<bool>& stop) = nullptr;
};

const std::vector<StudyKind>& study_kinds() {
  static const std::vector<StudyKind> kinds = {
      {"estimators",
       "mean and variance of every measurement update against distance",
       {"--out", "--log", "--cases", "--updates"}},
      {"monitoring",
       "every estimator x strategy x wind case, several seeds",
       {"--out", "--log", "--seeds", "--first-seed", "--threads", "--only-cases",
        "--estimators", "--strategies", "--set", "--plugin", "--trust"},
       monitoring},
      {"bridge",
       "a real fire, not star-shaped",
       {"--out", "--log", "--seeds", "--first-seed", "--threads", "--estimators",
        "--strategies", "--set", "--data", "--plugin", "--trust"},
       bridge},
      {"fidelity",
       "the default mission from kinematic points to aircraft in gusts",
       {"--out", "--log", "--seeds", "--first-seed", "--threads", "--only-cases", "--set",
        "--plugin", "--trust"},
       fidelity},
      {"wind-following",
       "plans made for the wind against plans made without it: how closely they are "
       "flown",
       {"--out", "--log", "--seeds", "--first-seed", "--threads", "--only-cases", "--set",
        "--plugin", "--trust"},
       following_study},
      {"robustness",
       "random wind, turbulence and wrong parameters (1000 runs): is control ever lost?",
       {"--out", "--log", "--seeds", "--first-seed", "--threads", "--only-cases", "--set",
        "--plugin", "--trust"},
       robustness},
      {"ground-starts",
       "starts from the ground in random wind and turbulence (500 runs): is any lost?",
       {"--out", "--log", "--seeds", "--first-seed", "--threads", "--only-cases", "--set",
        "--plugin", "--trust"},
       ground_starts_study},
      {"keeping",
       "how closely a glider and a quadrotor track their commands, by receiver",
       {"--out", "--log", "--seeds", "--first-seed", "--threads", "--only-cases", "--set",
        "--plugin", "--trust"},
       keeping_study},
      {"avoidance",
       "aircraft that will meet, flown to the end: how near they come and what that "
       "costs",
       {"--out", "--log", "--cases", "--only-cases", "--first-seed", "--threads",
        "--method", "--deal", "--plant", "--loss", "--delay", "--range", "--tracks",
        "--stranger-room", "--turbulence", "--separation", "--wind-from", "--records"},
       avoidance_study},
      {"network",
       "the radio medium beside ns-3 and Bianchi: network grid, network cell, network "
       "hidden; real and simulated modems: network mixed, network obstacle",
       {"experiment", "--out", "--log", "--seeds", "--first-seed", "--threads", "--nodes",
        "--profiles", "--duration"},
       network_study},
      {"tuning",
       "laps of waypoints, each with other gains; can search for gains",
       {"--out", "--log", "--seeds", "--first-seed", "--threads", "--gains", "--search",
        "--set", "--plugin", "--trust"},
       tuning_study}};
  return kinds;
}

// Null when there is none of this name.
const StudyKind* find_study(const std::string& name) {
  for (const StudyKind& kind : study_kinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

// What is wrong with the options of the command line; empty when nothing is.
std::string not_for(const StudyArguments& arguments) {
  const StudyKind* study = find_study(arguments.name);
  if (!study) {
    std::string names;
    for (const StudyKind& kind : study_kinds()) names += fmt::format(" {}", kind.name);
    return fmt::format("there is no study \"{}\". There are:{}.", arguments.name, names);
  }
  const auto given = [&](const char* option) {
    return std::count(arguments.given.begin(), arguments.given.end(), option) > 0;
  };
  for (const std::string& option : arguments.given) {
    if (option == "name" ||
        std::count(study->options.begin(), study->options.end(), option))
      continue;
    std::string takes;
    for (const std::string& each : study->options) takes += " " + each;
    return fmt::format("{} has no meaning for the study {}, which takes{}.", option,
                       study->name, takes);
  }
  if (arguments.name == "estimators" &&
      given("--cases") + given("--updates") + given("--out") > 1 &&
      (given("--cases") || given("--updates")))
    return "--cases and --updates write to standard output: give one of them, and no "
           "--out.";
  if (given("--gains") && given("--search"))
    return "--search starts from the scenario's own gains: give it no --gains.";
  return {};
}

std::string default_folder(const StudyArguments& arguments) {
  std::string name = "study-" + arguments.name;
  if (!arguments.experiment.empty()) name += "-" + arguments.experiment;
  return name;
}

}  // namespace

std::string list_of_studies() {
  std::string list;
  for (const StudyKind& kind : study_kinds())
    list += fmt::format("{:<15}{}\n", kind.name, kind.help);
  return list;
}

int study_command(const StudyArguments& arguments, const std::atomic<bool>& stop) {
  if (arguments.name.empty()) {
    print("{}", list_of_studies());
    return kDone;
  }
  if (const std::string odd = not_for(arguments); !odd.empty()) {
    complain("error: {}\nRun with --help for more information.\n", odd);
    return kBadUsage;
  }
  if (arguments.name == "estimators" && !arguments.cases_file.empty())
    return evaluate_rows(arguments.cases_file, campaign::evaluate_cases);
  if (arguments.name == "estimators" && !arguments.updates_file.empty())
    return evaluate_rows(arguments.updates_file, campaign::evaluate_updates);
  const fs::path folder = arguments.out.empty()
                              ? fs::path("runs") / default_folder(arguments)
                              : arguments.out;
  if (arguments.name == "estimators") return estimators(folder);
  auto kinds = load_kinds(arguments.plugins, arguments.trusted);
  if (!kinds) return kBadUsage;
  return find_study(arguments.name)->run(arguments, *kinds, folder, stop);
}

}  // namespace skein::app
