// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/study_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "skein/record/store/summary.h"

namespace skein::campaign {

StudyFigures study_figures(const StudyPlan& plan,
                           const std::vector<BatchOutcome>& outcomes) {
  StudyFigures figures{{"runs", 0}, {"runs_failed", 0}, {"runs_missing", 0}};
  for (const BatchOutcome& outcome : outcomes)
    ++figures[outcome.summary         ? "runs"
              : outcome.error.empty() ? "runs_missing"
                                      : "runs_failed"];
  for (const StudyCell& cell : plan.cells) {
    std::set<std::string> names;
    for (const std::size_t item : cell.items)
      if (outcomes[item].summary)
        for (const auto& [name, value] : outcomes[item].summary->numbers)
          if (!depends_on_machine(name)) names.insert(name);
    const std::string path = cell.path();
    const std::string prefix = path.empty() ? path : path + "/";
    figures[prefix + "runs"] = static_cast<double>(
        std::count_if(cell.items.begin(), cell.items.end(),
                      [&](std::size_t item) { return outcomes[item].summary; }));
    for (const std::string& name : names) {
      const MeanInterval figure = figure_of(cell, outcomes, name);
      figures[prefix + name] = figure.mean;
      if (figure.count > 1) figures[prefix + name + "_ci95"] = figure.half_width;
    }
  }
  return figures;
}

StudyFigures study_figures(std::span<const CurveTable> tables) {
  const std::string requested = "exact_";
  StudyFigures figures;
  for (const CurveTable& table : tables) {
    const auto exact = std::find_if(
        table.columns.begin(), table.columns.end(),
        [&](const Curve& column) { return column.name.starts_with(requested); });
    if (exact == table.columns.end()) continue;
    const std::string unit = exact->name.substr(exact->name.rfind('_'));  // "_m"
    for (auto column = table.columns.begin() + 1; column != table.columns.end();
         ++column) {
      if (column == exact || !column->name.ends_with(unit)) continue;
      double max = 0;
      for (std::size_t i = 0; i < column->values.size(); ++i)
        max = std::max(max, std::abs(column->values[i] - exact->values[i]));
      const std::string name = column->name.substr(0, column->name.size() - unit.size());
      figures[fmt::format("{}/{}_max_error{}", table.name, name, unit)] = max;
    }
  }
  return figures;
}

Result<void> write_study_summary(const std::string& study, const std::string& version,
                                 const std::string& state, const StudyFigures& figures,
                                 const std::filesystem::path& folder) {
  return record::write_flat_json(
      {{"study", study}, {"version", version}, {"state", state}}, figures,
      folder / "summary.json");
}

}  // namespace skein::campaign
