// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/common/commands.h"
#include "app/study/arguments.h"
#include "skein/assemble/kinds/kind_registry.h"
#include "skein/base/result.h"
#include "skein/campaign/batch/batch.h"
#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/record/report/study_report.h"
#include "skein/role/recorder.h"

namespace skein::app {

// What studies have in common.

/// A shipped scenario: beside the working folder, installed with the program, or beside
/// the program's checkout.
std::filesystem::path shipped_scenario(const std::string& name);

/// Scenario, overrides and seeds of a study as the command line has them; the study's own
/// number of seeds where it names none.
template <class Study>
void take_arguments(const StudyArguments& arguments, const char* scenario, Study& study) {
  study.base = shipped_scenario(scenario);
  study.overrides = arguments.overrides;
  study.first_seed = arguments.first_seed;
  if (arguments.seeds) study.seeds = *arguments.seeds;
}

/// Reads the scenarios of runs; libraries that they name are loaded with the consent that
/// `kinds` asks for, as by `skein run`.
/// @param kinds    outlives it.
/// @param plugins  of the command line.
/// @param stop     outlives it: reading ends when somebody asks to stop.
campaign::ScenarioReader reader_of(assemble::KindRegistry& kinds,
                                   const std::vector<std::string>& plugins,
                                   const std::atomic<bool>& stop);

/// Made when there is something to put into it: what is refused leaves nothing behind.
/// Until it ends, this program is the only one that writes there.
/// Fails: kUnavailable when it cannot be made; kBadInput when another program writes
///        there.
Result<void> make_folder(const std::filesystem::path& folder);

/// On standard output, in columns.
void print_table(const record::StudyTable& table);

/// Says what failed and stores its scenario, if it has one, to replay it; false when
/// nothing did.
bool report_failures(const std::vector<campaign::BatchItem>& items,
                     const std::vector<campaign::BatchOutcome>& outcomes,
                     const std::filesystem::path& folder);

/// Runs one item without records.
Result<record::RunSummary> run_item(const campaign::BatchItem& item,
                                    const assemble::KindRegistry& kinds,
                                    const std::atomic<bool>& stop,
                                    Recorder* listener = nullptr);

/// Runs all items of a plan, with progress on a terminal; what is finished is kept in the
/// folder.
/// @param threads  runs at the same time.
/// @param run  of one item; none: run_item().
Result<std::vector<campaign::BatchOutcome>> run_plan(const campaign::StudyPlan& plan,
                                                     int threads,
                                                     const assemble::KindRegistry& kinds,
                                                     const std::filesystem::path& folder,
                                                     const std::atomic<bool>& stop,
                                                     campaign::RunScenario run = {});

/// Writes report, CSV and summary, prints the tables; returns the exit status.
/// @param more  figures of the summary besides the means over the runs.
int finish(const std::string& study, const campaign::StudyPlan& plan,
           const std::vector<campaign::BatchOutcome>& outcomes,
           const record::StudyReport& report, const std::filesystem::path& folder,
           const std::atomic<bool>& stop, const std::map<std::string, double>& more = {});

/// `skein study estimators`; returns the exit status.
int estimators_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                     const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study monitoring`; returns the exit status.
int monitoring_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                     const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study bridge`; returns the exit status.
int bridge_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                 const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study fidelity`; returns the exit status.
int fidelity_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                   const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study robustness`; returns the exit status.
int robustness_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                     const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study wind-following`; returns the exit status.
int following_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                    const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study avoidance`; returns the exit status.
int avoidance_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                    const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study ground-starts`; returns the exit status.
int ground_starts_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                        const std::filesystem::path& folder,
                        const std::atomic<bool>& stop);

/// `skein study keeping`; returns the exit status.
int keeping_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                  const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study network EXPERIMENT`; returns the exit status.
int network_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                  const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study network mixed`; returns the exit status.
int mixed_rates_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                      const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study network obstacle`; returns the exit status.
int obstacle_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                   const std::filesystem::path& folder, const std::atomic<bool>& stop);

/// `skein study tuning`; returns the exit status.
int tuning_study(const StudyArguments& arguments, assemble::KindRegistry& kinds,
                 const std::filesystem::path& folder, const std::atomic<bool>& stop);

}  // namespace skein::app
