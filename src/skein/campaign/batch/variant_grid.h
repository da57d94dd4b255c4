// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/monitoring/monitoring_study.h"

namespace skein::campaign {

/// A scenario in every combination of some changes, several seeds each. A dimension
/// without variants does not change anything.
struct VariantGrid {
  std::filesystem::path base;  ///< the scenario that is changed
  std::vector<Variant> cases, strategies, estimators;
  std::vector<std::string> overrides;  ///< for every run, applied last
  int first_seed = 1;
  int seeds = 1;
};

/// The variants called `names`, all when there are none.
/// Fails: kBadInput for a name that does not exist; `what` says what it should be.
Result<std::vector<Variant>> select(std::vector<Variant> all,
                                    const std::vector<std::string>& names,
                                    const char* what);

/// All runs of the grid: cells by case, then strategy, then estimator; runs by seed.
/// Fails: kBadInput when a change does not fit the scenario.
Result<StudyPlan> plan_grid(VariantGrid grid, const ScenarioReader& reader);

}  // namespace skein::campaign
