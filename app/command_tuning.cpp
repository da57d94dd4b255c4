// The study `tuning`: laps with other gains, and the search for gains.
#include <fmt/core.h>
#include <unistd.h>

#include <set>

#include "app/common.h"
#include "app/output.h"
#include "app/study_parts.h"
#include "app/version.h"
#include "assemble/kinds_of.h"
#include "assemble/run.h"
#include "assemble/tuning_gains.h"
#include "base/log.h"
#include "campaign/tuning_report.h"
#include "scenario/scenario_file.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;
using autopilot::LapGains;

constexpr double kSoft = 0.6, kStiff = 1.6;  // quickness of the shipped sets
constexpr int kLeastFreshSeeds = 10;         // to judge what a search has found

// Flies one item; its laps become figures of the summary.
Result<record::RunSummary> fly(const campaign::BatchItem& item,
                               const std::atomic<bool>& stop,
                               campaign::LapRecorder& laps) {
  assemble::QuietRun how;
  how.version = kVersion;
  how.stop = &stop;
  how.listener = &laps;
  auto summary = assemble::run_quietly(item.scenario, how);
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

// The search over the study's seeds, told as it goes.
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
      complain("\r{} of {} gains tried, least cost {:.3f} ", tried, tries, best);
    else
      log_info("{} of {} gains tried, least cost {:.3f}", tried, tries, best);
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

// Flight `k` of the plan again, for its pictures.
std::vector<campaign::LapSample> samples_of(const campaign::BatchItem& item,
                                            const std::atomic<bool>& stop) {
  campaign::LapRecorder laps;
  const auto flown = fly(item, stop, laps);
  return flown.ok() ? laps.samples() : std::vector<campaign::LapSample>{};
}

}  // namespace

int tuning_study(const StudyArguments& arguments, const fs::path& folder,
                 const std::atomic<bool>& stop) {
  const scenario::KindTable kinds = assemble::kind_table();
  campaign::TuningStudy study;
  study.base = shipped_scenario("tuning.yaml");
  study.overrides = arguments.overrides;
  study.first_seed = arguments.first_seed;
  study.seeds = arguments.seeds;

  std::vector<scenario::Override> overrides;
  for (const std::string& text : arguments.overrides) overrides.push_back({text});
  const auto read = scenario::read_scenario(study.base, kinds, overrides);
  if (!read.ok()) return say_error({ErrorCode::kBadInput, "", read.report(), ""});
  const auto base = assemble::tuning_gains_of(*read.scenario);
  if (!base) return say_error(base.error());
  auto sets = sets_of(arguments, base.value());
  if (!sets) return say_error(sets.error());
  study.sets = std::move(sets).value();
  if (const auto plan = campaign::plan_tuning_study(study, kinds); !plan)
    return say_error(plan.error());
  if (auto made = make_folder(folder); !made) return say_error(made.error());

  const bool terminal = isatty(STDERR_FILENO) != 0;
  campaign::BatchOptions options;
  options.threads = arguments.threads;
  options.program = program_fingerprint();
  options.journal = folder / "runs.jsonl";
  options.stop = &stop;
  const campaign::RunScenario run = [&](const campaign::BatchItem& item) {
    campaign::LapRecorder laps;
    return fly(item, stop, laps);
  };

  campaign::TuningSearch search;
  campaign::TuningFound found;
  if (arguments.search > 0) {
    search = make_search(study, arguments.search, base.value(), terminal);
    auto searched = campaign::search_gains(search, kinds, run, options);
    if (terminal) complain("\n");
    if (!searched) return say_error(searched.error());
    found = std::move(searched).value();
    if (!found.error.empty()) complain("search: {}\n", found.error);
    if (found.search.tries.empty()) {
      print("No set of gains has been flown.\n");
      return stop ? kInterrupted : kFailed;
    }
    const LapGains best = with_values(base.value(), assemble::tuning_knobs(base.value()),
                                      found.search.best.at);
    if (auto written = write_text(folder / "gains.yaml", gains_file(best, found));
        !written)
      return say_error(written.error());
    // Judged by flights that the search has not seen.
    study.sets = {{"default", assemble::lap_gains_text(base.value())},
                  {"found", assemble::lap_gains_text(best)}};
    study.first_seed += study.seeds;
    study.seeds = std::max(study.seeds, kLeastFreshSeeds);
  }

  const auto plan = campaign::plan_tuning_study(study, kinds);
  if (!plan) return say_error(plan.error());
  options.progress = [terminal](std::size_t done, std::size_t all) {
    if (terminal) complain("\r{} of {} flights ", done, all);
  };
  const auto flown = campaign::run_batch(plan.value().items, run, options);
  if (terminal) complain("\n");
  if (!flown) return say_error(flown.error());
  const auto& outcomes = flown.value();

  const std::size_t shown = 0;
  std::vector<campaign::LapSample> samples;
  if (outcomes[plan.value().flights[shown].item].summary)
    samples = samples_of(plan.value().items[plan.value().flights[shown].item], stop);
  auto report = campaign::tuning_report(study, plan.value(), outcomes, shown, samples);
  auto figures = campaign::tuning_figures(study, plan.value(), outcomes);
  if (arguments.search > 0) {
    campaign::add_search(search, found, study, plan.value(), outcomes, report);
    campaign::add_search_figures(found, plan.value(), outcomes, figures);
    if (found.search.stopped && report.alert.empty())
      report.alert = fmt::format("partial: the search ended after {} of {} gains",
                                 found.search.tries.size(), arguments.search);
  }

  const bool failed = tell_failures(plan.value().items, outcomes, folder);
  if (auto written = write_text(folder / "runs.csv",
                                campaign::tuning_csv(study, plan.value(), outcomes));
      !written)
    return say_error(written.error());
  if (auto written = record::write_study_report(report, folder / "report.html"); !written)
    return say_error(written.error());
  if (auto written = campaign::write_study_summary(
          "tuning", kVersion, report.alert.empty() ? "complete" : report.alert, figures,
          folder);
      !written)
    return say_error(written.error());
  for (const record::StudyTable& table : report.tables) print_table(table);
  for (const std::string& warning : campaign::warnings_of(outcomes))
    log_warning("{}", warning);
  if (arguments.search > 0) print("\n{}\n", report.intro.back());
  if (!report.alert.empty()) print("\n{}\n", report.alert);
  print("\nWritten: {}  summary.json  runs.csv  runs.jsonl{}\n",
        (folder / "report.html").string(), arguments.search > 0 ? "  gains.yaml" : "");
  if (stop) return kInterrupted;
  return failed || !found.error.empty() ? kFailed : kDone;
}

}  // namespace skein::app
