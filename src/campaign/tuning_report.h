#pragma once

#include <string>
#include <vector>

#include "campaign/lap_recorder.h"
#include "campaign/tuning_search.h"
#include "campaign/tuning_study.h"
#include "record/study_report.h"

namespace skein::campaign {

/// The study as a page: what each set of gains achieves over all seeds, the laps of one
/// flight, that flight over time and on the map.
///
/// @param shown    which of the plan's flights is shown.
/// @param samples  of that flight; empty: it was not flown.
record::StudyReport tuning_report(const TuningStudy& study, const TuningPlan& plan,
                                  const std::vector<BatchOutcome>& outcomes,
                                  std::size_t shown,
                                  const std::vector<LapSample>& samples);

/// What the search tried and found. Put before the report of the flights that compare
/// both: sets 0 (where it started) and 1 (found) of `study`.
void add_search(const TuningSearch& search, const TuningFound& found,
                const TuningStudy& study, const TuningPlan& plan,
                const std::vector<BatchOutcome>& outcomes, record::StudyReport& report);

/// `search/tried`, `search/cost_start`, `search/cost_found` on the seeds of the search;
/// `search/cost_change` and its `_ci95`, found less start, on the seeds of `plan`.
void add_search_figures(const TuningFound& found, const TuningPlan& plan,
                        const std::vector<BatchOutcome>& outcomes, StudyFigures& figures);

}  // namespace skein::campaign
