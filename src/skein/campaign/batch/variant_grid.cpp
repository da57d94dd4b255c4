// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/variant_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "skein/campaign/batch/data_fingerprint.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/scenario_file.h"

namespace skein::campaign {

Result<std::vector<Variant>> select(std::vector<Variant> all,
                                    const std::vector<std::string>& names,
                                    const char* what) {
  if (names.empty()) return all;
  std::vector<Variant> chosen;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Variant& v) { return v.name == name; });
    if (found == all.end()) {
      std::string known;
      for (const Variant& variant : all) known += " " + variant.name;
      return Error{ErrorCode::kBadInput, name, fmt::format("is no {}.", what),
                   fmt::format("There are:{}.", known)};
    }
    chosen.push_back(*found);
  }
  return chosen;
}

Result<StudyPlan> plan_grid(VariantGrid grid, const ScenarioReader& reader) {
  for (auto* dimension : {&grid.cases, &grid.strategies, &grid.estimators})
    if (dimension->empty()) dimension->push_back({"-", "", {}});
  StudyPlan plan;
  DataFingerprint data;
  for (const Variant& each : grid.cases)
    for (const Variant& strategy : grid.strategies)
      for (const Variant& estimator : grid.estimators) {
        StudyCell cell{each.name, estimator.name, strategy.name, {}};
        std::vector<scenario::Override> overrides;
        for (const auto* list : {&each.overrides, &strategy.overrides,
                                 &estimator.overrides, &std::as_const(grid.overrides)})
          for (const std::string& text : *list) overrides.push_back({text});
        auto read = reader.read(grid.base, overrides);
        if (!read) return read.error();
        const auto files = data.of(scenario::named_files(read.value(), reader.kinds()));
        if (!files) return files.error();
        for (int k = 0; k < grid.seeds; ++k) {
          if (auto going = reader.go_on(); !going) return going.error();
          scenario::Scenario run = read.value();
          run.seed = static_cast<std::uint64_t>(grid.first_seed + k);
          run.name = fmt::format("{}/{}/{}/{}", each.name, strategy.name, estimator.name,
                                 run.seed);
          cell.items.push_back(plan.items.size());
          std::string text = scenario::write_scenario(run, reader.kinds());
          plan.items.push_back(
              {run.name, std::move(run), std::move(text), files.value()});
        }
        plan.cells.push_back(std::move(cell));
      }
  return plan;
}

}  // namespace skein::campaign
