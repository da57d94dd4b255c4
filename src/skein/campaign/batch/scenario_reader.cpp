// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/scenario_reader.h"

#include <algorithm>

namespace skein::campaign {

Result<void> ScenarioReader::go_on() const {
  if (stop_ && *stop_)
    return Error{ErrorCode::kInterrupted, "",
                 "Stopped while the runs were prepared; none was begun.", ""};
  return {};
}

Result<scenario::Scenario> ScenarioReader::read(
    const std::filesystem::path& file,
    std::span<const scenario::Override> overrides) const {
  if (auto going = go_on(); !going) return going.error();
  auto opened = opened_.find(file);
  if (opened == opened_.end())
    opened = opened_.emplace(file, scenario::open_scenario(file)).first;
  scenario::ReadOutcome outcome =
      scenario::read_scenario(opened->second, kinds_, overrides, load_);
  if (!outcome.ok()) return Error{ErrorCode::kBadInput, "", outcome.report(), ""};
  std::vector<std::string>& named = outcome.scenario->plugins;
  for (const std::string& plugin : plugins_)
    if (std::find(named.begin(), named.end(), plugin) == named.end())
      named.push_back(plugin);
  return *std::move(outcome.scenario);
}

}  // namespace skein::campaign
