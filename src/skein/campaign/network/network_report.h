// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "skein/campaign/network/network_study.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// The study as a page: tables beside what ns-3.37 and, for a saturated cell, Bianchi's
/// model say, what it cost, and plots against the number of nodes.
record::StudyReport network_report(const NetworkStudy& study,
                                   const NetworkStudyPlan& planned,
                                   const std::vector<BatchOutcome>& outcomes);

/// How far means are off the references, as figures of a summary:
/// PROFILE/ACCESS/NODES/FIGURE_off_percent, and `loss_off_points`; where there are none,
/// nothing.
std::map<std::string, double> network_comparison(
    const NetworkStudyPlan& planned, NetworkExperiment experiment,
    const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
