// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/bridge/bridge_study.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace skein::campaign {

Result<StudyPlan> plan_bridge_study(const BridgeStudy& study,
                                    const ScenarioReader& reader) {
  MonitoringStudy grid;
  grid.base = study.base;
  grid.cases = {"no-wind"};  // the case without changes: the base scenario as it is
  grid.estimators = study.estimators.empty()
                        ? std::vector<std::string>{"ensemble", "joint", "point-reset"}
                        : study.estimators;
  grid.strategies =
      study.strategies.empty()
          ? std::vector<std::string>{"sweep", "tracking-binary", "gus-rate", "gus"}
          : study.strategies;
  grid.overrides = study.overrides;
  grid.first_seed = study.first_seed;
  grid.seeds = study.seeds;
  auto plan = plan_monitoring_study(grid, reader);
  if (!plan) return plan;
  for (StudyCell& cell : plan.value().cells) cell.case_name = "recorded fire";
  return plan;
}

namespace {

struct Mark {
  const char* figure;
  const char* heading;
  double value;
  bool at_least;
  int digits;
};
constexpr Mark kMarks[] = {
    {"iou_mean", "IoU", 0.90, true, 3},
    {"boundary_rms_mean_m", "boundary RMS [m]", 35, false, 1},
    {"boundary_hausdorff_mean_m", "Hausdorff [m]", 120, false, 1},
    {"coverage_95_mean", "coverage 95 %", 0.85, true, 3},
    {"nees_mean", "NEES", 2, false, 2},
};

}  // namespace

record::StudyReport bridge_report(const BridgeStudy& study, const StudyPlan& plan,
                                  const std::vector<BatchOutcome>& outcomes) {
  record::StudyReport report;
  report.title = "Study: bridge";
  report.intro = {fmt::format(
      "A real fire as truth: dated perimeters, interpolated in time. {} seeds from {} "
      "on; means over the allocation phase, ± the 95 % confidence interval over the "
      "seeds. The aircraft are given roughly where the fire is and how large; neither "
      "wind, fuel nor rates.",
      study.seeds, study.first_seed)};
  record::StudyTable table;
  table.title = "How well the perimeter was known";
  table.caption =
      "Highlighted: reaches the mark (IoU at least 0.90, RMS at most 35 m, Hausdorff at "
      "most 120 m, coverage at least 0.85, NEES at most 2).";
  table.columns = {"strategy", "estimator"};
  for (const Mark& mark : kMarks) table.columns.push_back(mark.heading);
  for (const StudyCell& cell : plan.cells) {
    std::vector<record::TableCell> row = {{cell.strategy}, {cell.estimator}};
    for (const Mark& mark : kMarks) {
      const MeanInterval value = figure_of(cell, outcomes, mark.figure);
      if (value.count == 0) {
        row.push_back({std::numeric_limits<double>::quiet_NaN()});
        continue;
      }
      const bool good =
          mark.at_least ? value.mean >= mark.value : value.mean <= mark.value;
      row.push_back({figure_text(value, mark.digits), good});
    }
    table.rows.push_back(std::move(row));
  }
  report.tables.push_back(std::move(table));
  report.alert = partial_text(outcomes);
  report.notes = warnings_of(outcomes);
  return report;
}

}  // namespace skein::campaign
