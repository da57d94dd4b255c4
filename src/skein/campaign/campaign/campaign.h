// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/campaign/campaign_file.h"
#include "skein/record/report/study_report.h"

namespace skein::campaign {

/// How a campaign is flown, as the command line has it.
struct CampaignOptions {
  std::vector<std::string> only;       ///< names of variants; of an axis without any: all
  std::vector<std::string> overrides;  ///< KEY=VALUE for every run, applied last
};

/// All runs of a campaign: a cell for each combination of variants, its runs by seed. The
/// variants of the first axis change slowest.
///
/// A run's draws depend on its seed and on their places in the list alone, so that all
/// cells meet the same conditions.
/// Fails: kBadInput for a variant that there is not, and when a change does not fit the
///        scenario.
Result<StudyPlan> plan_campaign(const CampaignFile& file, const CampaignOptions& options,
                                const ScenarioReader& reader);

/// What the file asks for in vain: a line for each figure that no run has.
std::vector<std::string> figures_that_nobody_has(
    const CampaignFile& file, const std::vector<BatchOutcome>& outcomes);

/// A table with a row for each cell: mean and 95 % confidence interval of every figure,
/// with its worst run where the file asks for that; and a plot for each figure.
record::StudyReport campaign_report(const CampaignFile& file, const StudyPlan& plan,
                                    const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
