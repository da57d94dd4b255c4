// SPDX-License-Identifier: Apache-2.0
// The study `tuning`: laps with other gains, and the search for gains.
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/version.h"
#include "app/study/parts.h"
#include "skein/assemble/kinds/tuning_gains.h"
#include "skein/assemble/world/run.h"
#include "skein/base/log.h"
#include "skein/base/output_file.h"
#include "skein/campaign/tuning/tuning_report.h"
#include "skein/scenario/scenario_file.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;
using autopilot::LapGains;

constexpr double kSoft = 0.6, kStiff = 1.6;  // quickness of the shipped sets
constexpr int kMinFreshSeeds = 10;           // to judge what a search has found

// Flies one item; its laps become figures of the summary.
Result<record::RunSummary> fly(const campaign::BatchItem& item,
                               const assemble::KindRegistry& kinds,
                               const std::atomic<bool>& stop,
                               campaign::LapRecorder& laps) {
  assemble::QuietRun how;
  how.version = kVersion;
  how.stop = &stop;
  how.listener = &laps;
  auto summary = assemble::run_quietly(item.scenario, kinds, how);
  if (summary.ok()) laps.add_figures(summary.value().numbers);
  return summary;
}

Result<std::vector<campaign::GainSet>> sets_of(const StudyArguments& arguments,
                                               const LapGains& base) {
  const auto named = [](std::string name, const LapGains& gains) {
    return campaign::GainSet{std::move(name), assemble::lap_gains_text(gains)};
  };
  if (arguments.gains.empty())
    return std::vector<campaign::GainSet>{
        named("soft", assemble::quickened(base, kSoft)), named("default", base),
        named("stiff", assemble::quickened(base, kStiff))};
  std::vector<campaign::GainSet> sets = {named("default", base)};
  std::set<std::string> names = {"default"};
  for (const std::string& file : arguments.gains) {
    const auto gains = assemble::read_tuning_gains(file, base);
    if (!gains) return gains.error();
    const std::string stem = folder_name(fs::path(file).stem().string());
    std::string name = stem;
    for (int k = 2; !names.insert(name).second; ++k) name = fmt::format("{}-{}", stem, k);
    sets.push_back(named(name, gains.value()));
  }
  return sets;
}

LapGains with_values(LapGains gains, const std::vector<assemble::TuningKnob>& knobs,
                     const std::vector<double>& values) {
  for (std::size_t k = 0; k < knobs.size(); ++k) knobs[k].set(gains, values[k]);
  return gains;
}

// The search over the study's seeds, reported as it goes.
campaign::TuningSearch make_search(const campaign::TuningStudy& study, int tries,
                                   const LapGains& base, bool terminal) {
  campaign::TuningSearch search;
  search.study = study;
  search.evaluations = tries;
  const auto knobs = assemble::tuning_knobs(base);
  for (const assemble::TuningKnob& knob : knobs) {
    search.keys.push_back(knob.key);
    search.start.push_back(knob.get(base));
  }
  search.lap_gains = [base, knobs](const std::vector<double>& values) {
    return assemble::lap_gains_text(with_values(base, knobs, values));
  };
  search.progress = [terminal, tries](int tried, double best) {
    if (terminal)
      complain("\r{} of {} gains tried, minimum cost {:.3f} ", tried, tries, best);
    else
      log_info("{} of {} gains tried, minimum cost {:.3f}", tried, tries, best);
  };
  return search;
}

std::string gains_file(const LapGains& gains, const campaign::TuningFound& found) {
  return fmt::format(
      "# Gains found by skein study tuning: cost {:.3f}, before {:.3f}.\n"
      "# Put fixed_wing_gains into the aircraft's file, lateral into the scenario's\n"
      "# autopilot; or fly this file with skein study tuning --gains FILE.\n{}",
      found.search.best.cost, found.search.tries.front().cost,
      assemble::write_tuning_gains(gains));
}

// The study while it goes on.
class Tuning {
 public:
  Tuning(const StudyArguments& arguments, assemble::KindRegistry& kinds,
         const fs::path& folder, const std::atomic<bool>& stop)
      : arguments_(arguments),
        kinds_(kinds),
        reader_(reader_of(kinds, arguments.plugins, stop)),
        last_reader_(reader_of(kinds, arguments.plugins, never_)),
        folder_(folder),
        stop_(stop) {
    take_arguments(arguments, "tuning.yaml", study_);
    options_.threads = arguments.threads;
    options_.program = program_fingerprint();
    options_.journal = folder / "runs.jsonl";
    options_.stop = &stop;
    run_ = [this](const campaign::BatchItem& item) {
      campaign::LapRecorder laps;
      return fly(item, kinds_, stop_, laps);
    };
  }

  // Reads everything; what is wrong with it is found here.
  Result<void> prepare() {
    std::vector<scenario::Override> overrides;
    for (const std::string& text : arguments_.overrides) overrides.push_back({text});
    const auto read = reader_.read(study_.base, overrides);
    if (!read) return read.error();
    auto base = assemble::tuning_gains_of(read.value());
    if (!base) return base.error();
    base_ = std::move(base).value();
    auto sets = sets_of(arguments_, base_);
    if (!sets) return sets.error();
    study_.sets = std::move(sets).value();
    auto plan = campaign::plan_laps(study_, reader_);
    if (!plan) return plan.error();
    plan_ = std::move(plan).value();
    return make_folder(folder_);
  }

  // Looks for gains, then plans flights that compare them with those at the start.
  Result<void> search() {
    search_ = make_search(study_, arguments_.search, base_, terminal_);
    auto found = campaign::search_gains(search_, reader_, run_, options_);
    if (terminal_) complain("\n");
    if (!found) return found.error();
    found_ = std::move(found).value();
    if (found_.search.tries.empty())
      return Error{stop_ ? ErrorCode::kInterrupted : ErrorCode::kUnavailable, "search",
                   found_.error.empty() ? "no gains have been flown." : found_.error, ""};
    const LapGains best =
        with_values(base_, assemble::tuning_knobs(base_), found_.search.best.at);
    if (auto written = write_file(folder_ / "gains.yaml", gains_file(best, found_));
        !written)
      return written.error();
    study_.sets = {{"default", assemble::lap_gains_text(base_)},
                   {"found", assemble::lap_gains_text(best)}};
    study_.first_seed += study_.seeds;
    study_.seeds = std::max(study_.seeds, kMinFreshSeeds);
    // Also after an interruption, so that what was found is reported.
    auto plan = campaign::plan_comparison(study_, last_reader_);
    if (!plan) return plan.error();
    plan_ = std::move(plan).value();
    return {};
  }

  Result<void> fly_all() {
    options_.progress = [this](std::size_t done, std::size_t all) {
      if (terminal_) complain("\r{} of {} flights ", done, all);
    };
    auto flown = campaign::run_batch(plan_.items, run_, options_);
    if (terminal_) complain("\n");
    if (!flown) return flown.error();
    outcomes_ = std::move(flown).value();
    // The first flight again for its pictures; of a comparison the first of each set.
    const std::size_t step = plan_.flights.front().changes()
                                 ? plan_.flights.size()
                                 : static_cast<std::size_t>(study_.seeds);
    for (std::size_t k = 0; k < plan_.flights.size(); k += step) {
      const std::size_t item = plan_.flights[k].item;
      campaign::LapRecorder laps;
      if (outcomes_[item].summary && fly(plan_.items[item], kinds_, stop_, laps).ok())
        shown_.push_back({k, laps.samples()});
    }
    return {};
  }

  Result<void> write() {
    report_ = campaign::tuning_report(study_, plan_, outcomes_, shown_);
    auto figures = campaign::tuning_figures(study_, plan_, outcomes_);
    if (arguments_.search > 0) {
      campaign::add_search(search_, found_, study_, plan_, outcomes_, report_);
      campaign::add_search_figures(found_, plan_, outcomes_, figures);
    }
    std::string state = campaign::partial_text(outcomes_);
    if (found_.search.stopped && state.empty())
      state = report_.alert =
          fmt::format("partial: the search ended after {} of {} gains",
                      found_.search.tries.size(), arguments_.search);
    failed_ = report_failures(plan_.items, outcomes_, folder_) || !found_.error.empty();
    if (!found_.error.empty()) complain("search: {}\n", found_.error);
    if (auto written = write_file(folder_ / "runs.csv",
                                  campaign::tuning_csv(study_, plan_, outcomes_));
        !written)
      return written;
    if (auto written = record::write_study_report(report_, folder_ / "report.html");
        !written)
      return written;
    return campaign::write_study_summary(
        "tuning", kVersion, state.empty() ? "complete" : state, figures, folder_);
  }

  int report() const {
    for (const record::StudyTable& table : report_.tables) print_table(table);
    for (const std::string& warning : campaign::warnings_of(outcomes_))
      log_warning("{}", warning);
    if (arguments_.search > 0) print("\n{}\n", report_.intro.back());
    if (!report_.alert.empty()) print("\n{}\n", report_.alert);
    print("\nWritten: {}  summary.json  runs.csv  runs.jsonl{}\n",
          (folder_ / "report.html").string(),
          arguments_.search > 0 ? "  gains.yaml" : "");
    if (stop_) return kInterrupted;
    return failed_ ? kFailed : kDone;
  }

 private:
  const StudyArguments& arguments_;
  const assemble::KindRegistry& kinds_;
  const std::atomic<bool> never_ = false;
  campaign::ScenarioReader reader_, last_reader_;
  fs::path folder_;
  const std::atomic<bool>& stop_;
  const bool terminal_ = isatty(STDERR_FILENO) != 0;
  campaign::BatchOptions options_;
  campaign::RunScenario run_;
  campaign::TuningStudy study_;
  LapGains base_;
  campaign::TuningPlan plan_;
  campaign::TuningSearch search_;
  campaign::TuningFound found_;
  std::vector<campaign::BatchOutcome> outcomes_;
  std::vector<campaign::ShownFlight> shown_;
  record::StudyReport report_;
  bool failed_ = false;
};

}  // namespace

int tuning_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                 const fs::path& folder, const std::atomic<bool>& stop) {
  Tuning tuning(arguments, kinds, folder, stop);
  if (auto done = tuning.prepare(); !done) return say_error(done.error());
  if (arguments.search > 0)
    if (auto done = tuning.search(); !done) {
      say_error(done.error());
      return stop ? kInterrupted : kFailed;
    }
  if (auto done = tuning.fly_all(); !done) return say_error(done.error());
  if (auto done = tuning.write(); !done) return say_error(done.error());
  return tuning.report();
}

}  // namespace skein::app
