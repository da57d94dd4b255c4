// SPDX-License-Identifier: Apache-2.0
#include "app/study/parts.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/version.h"
#include "skein/assemble/kinds/load_plugin.h"
#include "skein/assemble/world/run.h"
#include "skein/base/folder_lock.h"
#include "skein/base/log.h"
#include "skein/base/output_file.h"
#include "skein/campaign/batch/study_summary.h"
#include "skein/campaign/monitoring/monitoring_report.h"

namespace skein::app {

namespace fs = std::filesystem;

fs::path shipped_scenario(const std::string& name) {
  const fs::path here = fs::path("scenarios") / name;
  std::error_code error;
  if (fs::exists(here, error)) return here;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed =
      program.parent_path().parent_path() / "share" / "skein" / "scenarios" / name;
  if (fs::exists(installed, error)) return installed;
  return program.parent_path().parent_path().parent_path() / "scenarios" / name;
}

campaign::ScenarioReader reader_of(assemble::KindRegistry& kinds,
                                   const std::vector<std::string>& plugins,
                                   const std::atomic<bool>& stop) {
  std::vector<std::string> paths;
  for (const std::string& plugin : plugins)
    paths.push_back(fs::canonical(plugin).string());
  return {kinds.table(),
          [&kinds](const std::string& plugin, const scenario::Source& named_in) {
            return assemble::load_named_plugin(plugin, named_in, kinds);
          },
          std::move(paths), &stop};
}

namespace {

// That this program writes into until it ends.
std::map<fs::path, FolderLock>& own_folders() {
  static std::map<fs::path, FolderLock> folders;
  return folders;
}

}  // namespace

Result<void> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    return Error{ErrorCode::kUnavailable, folder.string(),
                 "cannot be made: " + error.message() + ".", ""};
  const fs::path whole = fs::weakly_canonical(folder, error);
  if (own_folders().contains(whole)) return {};
  auto lock = FolderLock::take(folder, "a study or campaign");
  if (!lock) return lock.error();
  own_folders().emplace(whole, std::move(lock).value());
  return {};
}

namespace {

std::string cell_text(const record::TableCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell.value)) return *text;
  const double number = std::get<double>(cell.value);
  return std::isnan(number) ? "-" : fmt::format("{:.3g}", number);
}

}  // namespace

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

bool report_failures(const std::vector<campaign::BatchItem>& items,
                     const std::vector<campaign::BatchOutcome>& outcomes,
                     const fs::path& folder) {
  bool failed = false;
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (!outcomes[i].error.empty()) {
      failed = true;
      const fs::path replay = folder / ("failed-" + folder_name(items[i].name) + ".yaml");
      complain("{}: {}\n", items[i].name, outcomes[i].error);
      if (!items[i].text.empty() && write_file(replay, items[i].text))
        complain("Replay: skein run {}\n", replay.string());
    }
  return failed;
}

Result<record::RunSummary> run_item(const campaign::BatchItem& item,
                                    const assemble::KindRegistry& kinds,
                                    const std::atomic<bool>& stop, Recorder* listener) {
  assemble::QuietRun how;
  how.version = kVersion;
  how.stop = &stop;
  how.listener = listener;
  return assemble::run_quietly(item.scenario, kinds, how);
}

Result<std::vector<campaign::BatchOutcome>> run_plan(
    const campaign::StudyPlan& plan, int threads, const assemble::KindRegistry& kinds,
    const fs::path& folder, const std::atomic<bool>& stop, campaign::RunScenario run) {
  if (auto made = make_folder(folder); !made) return made.error();
  const bool terminal = isatty(STDERR_FILENO) != 0;
  campaign::BatchOptions options;
  options.threads = threads;
  options.program = program_fingerprint();
  options.journal = folder / "runs.jsonl";
  options.stop = &stop;
  options.progress = [terminal](std::size_t done, std::size_t all) {
    if (terminal) complain("\r{} of {} runs", done, all);
  };
  if (!run)
    run = [&](const campaign::BatchItem& item) { return run_item(item, kinds, stop); };
  auto outcomes = campaign::run_batch(plan.items, run, options);
  if (terminal) complain("\n");
  return outcomes;
}

int finish(const std::string& study, const campaign::StudyPlan& plan,
           const std::vector<campaign::BatchOutcome>& outcomes,
           const record::StudyReport& report, const fs::path& folder,
           const std::atomic<bool>& stop, const std::map<std::string, double>& more) {
  campaign::StudyFigures figures = campaign::study_figures(plan, outcomes);
  figures.insert(more.begin(), more.end());
  const bool failed = report_failures(plan.items, outcomes, folder);
  if (auto written = write_file(folder / "runs.csv", campaign::runs_csv(plan, outcomes));
      !written)
    return say_error(written.error());
  if (auto written = record::write_study_report(report, folder / "report.html"); !written)
    return say_error(written.error());
  if (auto written = campaign::write_study_summary(
          study, kVersion, report.alert.empty() ? "complete" : report.alert, figures,
          folder);
      !written)
    return say_error(written.error());
  for (const record::StudyTable& table : report.tables) print_table(table);
  for (const std::string& warning : campaign::warnings_of(outcomes))
    log_warning("{}", warning);
  if (!report.alert.empty()) print("\n{}\n", report.alert);
  print("\nWritten: {}  summary.json  runs.csv  runs.jsonl\n",
        (folder / "report.html").string());
  if (stop) return kInterrupted;
  return failed ? kFailed : kDone;
}

}  // namespace skein::app
