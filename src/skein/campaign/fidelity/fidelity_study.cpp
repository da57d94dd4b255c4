// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/fidelity/fidelity_study.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "skein/campaign/batch/variant_grid.h"

namespace skein::campaign {
namespace {

constexpr const char* kWing = "aircraft[0].plant=fixed-wing";
constexpr const char* kSkein = "aircraft[0].autopilot=skein";
constexpr const char* kIdeal = "aircraft[0].sensors=[ideal-navigation, fire]";
constexpr const char* kFlight = "aircraft[0].sensors=[flight, fire]";

struct Column {
  const char* figure;
  const char* heading;
  int digits;
};
constexpr Column kMission[] = {
    {"iou_mean", "IoU", 3},
    {"boundary_rms_mean_m", "boundary RMS [m]", 1},
    {"boundary_hausdorff_mean_m", "Hausdorff [m]", 0},
    {"coverage_95_mean", "coverage 95 %", 3},
    {"nees_mean", "NEES", 2},
    {"crossings", "crossings", 0},
};
constexpr Column kFlying[] = {
    {"distance_flown_mean_m", "flown by each [m]", 0},
    {"cross_track_rms_m", "off its path, RMS [m]", 1},
    {"position_error_rms_m", "own position, RMS error [m]", 2},
    {"min_charge", "lowest charge left", 2},
    {"failsafes", "failsafes", 1},
    {"accidents", "accidents", 1},
};

record::StudyTable table_of(const StudyPlan& plan,
                            const std::vector<BatchOutcome>& outcomes,
                            std::span<const Column> columns) {
  record::StudyTable table;
  table.columns = {"level"};
  for (const Column& column : columns) table.columns.push_back(column.heading);
  for (const StudyCell& cell : plan.cells) {
    std::vector<record::TableCell> row = {{cell.case_name}};
    for (const Column& column : columns) {
      const MeanInterval value = figure_of(cell, outcomes, column.figure);
      if (value.count == 0)
        row.push_back({std::numeric_limits<double>::quiet_NaN()});
      else
        row.push_back({figure_text(value, column.digits)});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

record::StudyTable cost_table(const StudyPlan& plan,
                              const std::vector<BatchOutcome>& outcomes) {
  record::StudyTable table;
  table.title = "What it costs";
  table.caption =
      "Wall time of a run, everything included, without records, as measured when it "
      "ran; and how it compares with the first level.";
  table.columns = {"level", "seconds per simulated hour", "times the first",
                   "times real time"};
  double first = std::numeric_limits<double>::quiet_NaN();
  for (const StudyCell& cell : plan.cells) {
    const MeanInterval wall = figure_of(cell, outcomes, "wall_s");
    const MeanInterval simulated = figure_of(cell, outcomes, "simulated_s");
    if (wall.count == 0 || simulated.mean <= 0) continue;
    const double cost = wall.mean / simulated.mean * 3600;
    if (std::isnan(first)) first = cost;
    table.rows.push_back({{cell.case_name},
                          {fmt::format("{:.2f}", cost)},
                          {fmt::format("{:.2f}", cost / first)},
                          {fmt::format("{:.0f}", 3600 / cost)}});
  }
  return table;
}

}  // namespace

std::vector<Variant> fidelity_levels() {
  return {
      {"point", "a kinematic point, positions with a wandering error", {}},
      {"point-skein",
       "the same point flown by the autopilot skein, which is given the truth",
       {kSkein, kIdeal}},
      {"performance",
       "a point with a budget of energy",
       {"aircraft[0].plant={kind: performance, aircraft: aerosonde}", kSkein, kIdeal}},
      {"six-dof", "six degrees of freedom, given the truth", {kWing, kSkein, kIdeal}},
      {"sensors",
       "six degrees of freedom, estimator fed by sensors with errors",
       {kWing, kSkein, kFlight}},
      {"turbulence",
       "the same in moderate turbulence",
       {kWing, kSkein, kFlight,
        "environment.turbulence={kind: dryden, intensity: moderate}"}},
      {"uncertain",
       "the same, each aircraft up to 10 % different from what its autopilot knows",
       {kWing, kSkein, kFlight,
        "environment.turbulence={kind: dryden, intensity: moderate}",
        "aircraft[0].parameter_spread=0.1"}},
  };
}

Result<StudyPlan> plan_fidelity_study(const FidelityStudy& study,
                                      const ScenarioReader& reader) {
  const auto levels = select(fidelity_levels(), study.levels, "level");
  if (!levels) return levels.error();
  VariantGrid grid;
  grid.base = study.base;
  grid.cases = levels.value();
  grid.overrides = study.overrides;
  grid.first_seed = study.first_seed;
  grid.seeds = study.seeds;
  return plan_grid(grid, reader);
}

record::StudyReport fidelity_report(const FidelityStudy& study, const StudyPlan& plan,
                                    const std::vector<BatchOutcome>& outcomes) {
  record::StudyReport report;
  report.title = "Study: fidelity";
  report.intro = {fmt::format(
      "One mission, flown at several fidelities: the same fire, strategy and estimator. "
      "{} seeds from {} on; means over the seeds, ± their 95 % confidence interval.",
      study.seeds, study.first_seed)};
  for (const Variant& level : fidelity_levels())
    report.intro.push_back(fmt::format("{}: {}.", level.name, level.help));
  record::StudyTable mission = table_of(plan, outcomes, kMission);
  mission.title = "What the mission achieves";
  mission.caption = "Means over the allocation phase.";
  record::StudyTable flying = table_of(plan, outcomes, kFlying);
  flying.title = "What the aircraft do";
  flying.caption =
      "Off its path is measured by the autopilot itself; the error of the own position "
      "is that of its estimate against the truth.";
  report.tables = {std::move(mission), std::move(flying), cost_table(plan, outcomes)};
  report.alert = partial_text(outcomes);
  report.notes = warnings_of(outcomes);
  return report;
}

}  // namespace skein::campaign
