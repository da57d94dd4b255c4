// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/scenario_reader.h"

#include <algorithm>

namespace skein::campaign {

scenario::ReadOutcome ScenarioReader::read(
    const std::filesystem::path& file,
    std::span<const scenario::Override> overrides) const {
  scenario::ReadOutcome outcome = scenario::read_scenario(file, kinds_, overrides, load_);
  if (!outcome.ok()) return outcome;
  std::vector<std::string>& named = outcome.scenario->plugins;
  for (const std::string& plugin : plugins_)
    if (std::find(named.begin(), named.end(), plugin) == named.end())
      named.push_back(plugin);
  return outcome;
}

}  // namespace skein::campaign
