// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/campaign/batch/lap_recorder.h"
#include "skein/campaign/tuning/tuning_search.h"
#include "skein/campaign/tuning/tuning_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// A flight of the plan that is drawn.
struct ShownFlight {
  std::size_t flight = 0;  ///< of the plan
  std::vector<LapSample> samples;
};

/// The study as a page: what each set of gains achieves, lap by lap, over time and on the
/// map.
record::StudyReport tuning_report(const TuningStudy& study, const TuningPlan& plan,
                                  const std::vector<BatchOutcome>& outcomes,
                                  const std::vector<ShownFlight>& shown);

/// Adds what the search tried and found to the report of the flights that compare both:
/// sets 0 (where it started) and 1 (found) of `study`.
void add_search(const TuningSearch& search, const TuningFound& found,
                const TuningStudy& study, const TuningPlan& plan,
                const std::vector<BatchOutcome>& outcomes, record::StudyReport& report);

/// `search/tried`, `search/cost_start`, `search/cost_found` on the seeds of the search;
/// `search/cost_change` and its `_ci95`, found less start, on the seeds of `plan`.
void add_search_figures(const TuningFound& found, const TuningPlan& plan,
                        const std::vector<BatchOutcome>& outcomes, StudyFigures& figures);

}  // namespace skein::campaign
