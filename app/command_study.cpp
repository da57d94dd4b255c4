#include <fmt/core.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>

#include "app/commands.h"
#include "app/common.h"
#include "app/output.h"
#include "app/version.h"
#include "assemble/kinds_of.h"
#include "assemble/recorded_scenario.h"
#include "assemble/run.h"
#include "campaign/bridge_study.h"
#include "campaign/estimators_csv.h"
#include "campaign/estimators_study.h"
#include "campaign/monitoring_report.h"
#include "campaign/monitoring_study.h"
#include "campaign/study_summary.h"
#include "record/study_report.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

// A shipped scenario: beside the working folder, or beside the program's checkout.
fs::path shipped_scenario(const std::string& name) {
  const fs::path here = fs::path("scenarios") / name;
  if (fs::exists(here)) return here;
  std::error_code fault;
  const fs::path program = fs::read_symlink("/proc/self/exe", fault);
  return program.parent_path().parent_path().parent_path() / "scenarios" / name;
}

// --- estimators ---------------------------------------------------------------------

int evaluate_rows(const std::string& file,
                  std::vector<Error> (*evaluate)(std::istream&, const std::string&,
                                                 std::ostream&)) {
  std::ifstream stored;
  if (file != "-") {
    stored.open(file);
    if (!stored) return say_error({ErrorCode::kNotFound, file, "cannot be read.", ""});
  }
  const auto problems =
      evaluate(file == "-" ? std::cin : stored, file == "-" ? "stdin" : file, std::cout);
  for (const Error& problem : problems) complain("{}\n", problem.text());
  return problems.empty() ? kDone : kBadUsage;
}

// Distinct colours and order for the page: every column of a table over its first.
record::StudyPlot plot_of(const campaign::StudyTable& table) {
  record::StudyPlot plot;
  plot.title = table.title;
  plot.x_label = "bound [sigma of the prior]";
  plot.y_label = table.name;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    record::StudySeries series;
    series.name = table.columns[c].name;
    series.x = table.columns[0].values;
    series.y = table.columns[c].values;
    series.dashed = series.name == "exact";
    plot.series.push_back(std::move(series));
  }
  return plot;
}

int estimators(const fs::path& folder) {
  record::StudyReport report;
  report.title = "Study: estimators";
  report.intro = {
      "What one in/out reading teaches: a range with prior N(0, 1) is told to be above, "
      "or "
      "below, a bound. Mean and variance after that, against the bound, for every "
      "measurement update (figures 2.6 to 2.9 of the thesis).",
      "exact: by numerical integration. The variance of an approximation is its second "
      "moment about the value that it chose: never below the exact one."};
  const auto tables = campaign::estimators_study({});
  for (const campaign::StudyTable& table : tables) {
    report.plots.push_back(plot_of(table));
    std::ofstream csv(folder / (table.name + ".csv"));
    campaign::write_csv(table, csv);
    csv.close();
    if (!csv.good())
      return say_error(
          {ErrorCode::kUnavailable, folder.string(), "cannot be written.", ""});
  }
  if (auto written = record::write_study_report(report, folder / "report.html"); !written)
    return say_error(written.error());
  if (auto written = campaign::write_study_summary(
          "estimators", kVersion, campaign::study_figures(tables), folder);
      !written)
    return say_error(written.error());
  print("Written: {}  summary.json  and one CSV per figure\n",
        (folder / "report.html").string());
  return kDone;
}

// --- studies of many runs -----------------------------------------------------------

Result<std::vector<campaign::BatchOutcome>> run_plan(const campaign::StudyPlan& plan,
                                                     const StudyArguments& arguments,
                                                     const fs::path& folder,
                                                     const std::atomic<bool>& stop) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  campaign::BatchOptions options;
  options.threads = arguments.threads;
  options.version = kVersion;
  options.journal = folder / "runs.jsonl";
  options.stop = &stop;
  options.progress = [terminal](std::size_t done, std::size_t all) {
    if (terminal) complain("\r{} of {} runs", done, all);
  };
  auto outcomes = campaign::run_batch(
      plan.items,
      [&](const campaign::BatchItem& item) {
        assemble::QuietRun how;
        how.version = kVersion;
        how.stop = &stop;
        return assemble::run_quietly(item.scenario, how);
      },
      options);
  if (terminal) complain("\n");
  return outcomes;
}

std::string cell_text(const record::StudyCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell.value)) return *text;
  const double number = std::get<double>(cell.value);
  return std::isnan(number) ? "-" : fmt::format("{:.3g}", number);
}

void print_table(const record::StudyTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(column.size());
  for (const auto& row : table.rows)
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] = std::max(widths[c], cell_text(row[c]).size());
  print("\n{}\n", table.title);
  for (std::size_t c = 0; c < widths.size(); ++c)
    print("{:<{}}  ", table.columns[c], widths[c]);
  print("\n");
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c)
      print("{:<{}}  ", cell_text(row[c]), widths[c]);
    print("\n");
  }
}

int finish(const std::string& study, const campaign::StudyPlan& plan,
           const std::vector<campaign::BatchOutcome>& outcomes,
           const record::StudyReport& report, const fs::path& folder,
           const std::atomic<bool>& stop) {
  bool failed = false;
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (!outcomes[i].error.empty()) {
      failed = true;
      complain("{}: {}\n", plan.items[i].name, outcomes[i].error);
    }
  if (auto written = write_text(folder / "runs.csv", campaign::runs_csv(plan, outcomes));
      !written)
    return say_error(written.error());
  if (auto written = record::write_study_report(report, folder / "report.html"); !written)
    return say_error(written.error());
  if (auto written = campaign::write_study_summary(
          study, kVersion, campaign::study_figures(plan, outcomes), folder);
      !written)
    return say_error(written.error());
  for (const record::StudyTable& table : report.tables) print_table(table);
  print("\nWritten: {}  summary.json  runs.csv  runs.jsonl\n",
        (folder / "report.html").string());
  if (stop) return kInterrupted;
  return failed ? kFailed : kDone;
}

int monitoring(const StudyArguments& arguments, const fs::path& folder,
               const std::atomic<bool>& stop) {
  campaign::MonitoringStudy study;
  study.base = shipped_scenario("thesis-no-wind.yaml");
  study.cases = arguments.cases;
  study.estimators = arguments.estimators;
  study.strategies = arguments.strategies;
  study.overrides = arguments.overrides;
  study.first_seed = arguments.first_seed;
  study.seeds = arguments.seeds;
  const auto plan = campaign::plan_monitoring_study(study, assemble::kind_table());
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments, folder, stop);
  if (!outcomes) return say_error(outcomes.error());
  return finish("monitoring", plan.value(), outcomes.value(),
                campaign::monitoring_report(study, plan.value(), outcomes.value()),
                folder, stop);
}

int bridge(const StudyArguments& arguments, const fs::path& folder,
           const std::atomic<bool>& stop) {
  campaign::BridgeStudy study;
  study.base = shipped_scenario("bridge-fire.yaml");
  study.estimators = arguments.estimators;
  study.strategies = arguments.strategies;
  if (!arguments.data.empty()) {
    auto fitted = assemble::fit_recorded_scenario(arguments.data);
    if (!fitted) return say_error(fitted.error());
    study.overrides = std::move(fitted).value();
  }
  study.overrides.insert(study.overrides.end(), arguments.overrides.begin(),
                         arguments.overrides.end());
  study.first_seed = arguments.first_seed;
  study.seeds = arguments.seeds;
  const auto plan = campaign::plan_bridge_study(study, assemble::kind_table());
  if (!plan) return say_error(plan.error());
  const auto outcomes = run_plan(plan.value(), arguments, folder, stop);
  if (!outcomes) return say_error(outcomes.error());
  return finish("bridge", plan.value(), outcomes.value(),
                campaign::bridge_report(study, plan.value(), outcomes.value()), folder,
                stop);
}

}  // namespace

int study_command(const StudyArguments& arguments, const std::atomic<bool>& stop) {
  if (arguments.name.empty()) {
    print(
        "estimators   mean and variance of every measurement update against distance\n"
        "monitoring   every estimator x strategy x wind case, several seeds\n"
        "bridge       a real fire, not star-shaped\n");
    return kDone;
  }
  if (arguments.name == "estimators" && !arguments.cases_file.empty())
    return evaluate_rows(arguments.cases_file, campaign::evaluate_cases);
  if (arguments.name == "estimators" && !arguments.updates_file.empty())
    return evaluate_rows(arguments.updates_file, campaign::evaluate_updates);
  if (arguments.name != "estimators" && arguments.name != "monitoring" &&
      arguments.name != "bridge") {
    complain("There is no study \"{}\". There are: estimators monitoring bridge.\n",
             arguments.name);
    return kBadUsage;
  }
  const fs::path folder = arguments.out.empty()
                              ? fs::path("runs") / ("study-" + arguments.name)
                              : arguments.out;
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault)
    return say_error({ErrorCode::kUnavailable, folder.string(),
                      "cannot be made: " + fault.message() + ".", ""});
  if (arguments.name == "estimators") return estimators(folder);
  if (arguments.name == "monitoring") return monitoring(arguments, folder, stop);
  return bridge(arguments, folder, stop);
}

}  // namespace skein::app
