// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/campaign/estimators/estimators_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// The tables of estimators_study() as a page: one plot each, the exact curve dashed and
/// on top. A curve that would flatten all others leaves the picture, and the caption says
/// so.
/// @param sigma  of the prior that the tables were made with [m].
record::StudyReport estimators_report(const std::vector<CurveTable>& tables,
                                      double sigma);

}  // namespace skein::campaign
