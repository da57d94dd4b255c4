// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/campaign/monitoring/monitoring_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// The study as a page: a table of Perf per case (every estimator x strategy), tables of
/// coverage and NEES, all readings of the thesis's benchmark against its claim, and the
/// best of Skein's own against the fair benchmark.
record::StudyReport monitoring_report(const MonitoringStudy& study, const StudyPlan& plan,
                                      const std::vector<BatchOutcome>& outcomes);

/// One row per run: name, case, strategy, estimator, seed, then every figure.
std::string runs_csv(const StudyPlan& plan, const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
