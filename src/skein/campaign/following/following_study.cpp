// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/following/following_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/campaign/batch/variant_grid.h"

namespace skein::campaign {
namespace {

constexpr double kRunIn = 30;  // of following that does not count [s]
constexpr const char* kDubins = "dubins";
constexpr const char* kTrochoids = "trochoids";

std::vector<Variant> winds() {
  return {{"south",
           "5 m/s from the south",
           {"environment.wind={kind: uniform, speed_mps: 5, from_deg: 180}"}},
          {"east",
           "5 m/s from the east",
           {"environment.wind={kind: uniform, speed_mps: 5, from_deg: 90}"}}};
}

std::vector<Variant> curves() {
  return {{kDubins, "as if there were no wind", {"aircraft[0].agent.curves=dubins"}},
          {kTrochoids, "for the wind", {"aircraft[0].agent.curves=trochoids"}}};
}

std::vector<Variant> manners() {
  return {{"at-airspeed",
           "at constant airspeed, as autopilots without a clock do",
           {"aircraft[0].agent.keeps_times=false"}},
          {"in-time",
           "faster or slower to be where the plan is",
           {"aircraft[0].agent.keeps_times=true"}}};
}

std::string quantile_name(int percent) {
  return fmt::format("cross_track_q{:02}_m", percent);
}

// Of the distribution: 5, 10, ... 95, 99.
std::vector<int> percents() {
  std::vector<int> all;
  for (int percent = 5; percent < 100; percent += 5) all.push_back(percent);
  all.push_back(99);
  return all;
}

// The cell of a wind and a manner with these curves; null when it is not in the plan.
const StudyCell* cell_of(const StudyPlan& plan, const std::string& wind,
                         const std::string& curve, const std::string& manner) {
  for (const StudyCell& cell : plan.cells)
    if (cell.case_name == wind && cell.strategy == curve && cell.estimator == manner)
      return &cell;
  return nullptr;
}

double ratio_of(const StudyPlan& plan, const std::vector<BatchOutcome>& outcomes,
                const std::string& wind, const std::string& manner) {
  const auto q95 = [&](const char* curve) {
    const StudyCell* cell = cell_of(plan, wind, curve, manner);
    const MeanInterval value =
        cell ? figure_of(*cell, outcomes, quantile_name(95)) : MeanInterval{};
    return value.count > 0 ? value.mean : std::numeric_limits<double>::quiet_NaN();
  };
  return q95(kDubins) / q95(kTrochoids);
}

std::vector<std::string> winds_of(const StudyPlan& plan) {
  std::vector<std::string> names;
  for (const StudyCell& cell : plan.cells)
    if (std::find(names.begin(), names.end(), cell.case_name) == names.end())
      names.push_back(cell.case_name);
  return names;
}

record::StudyTable error_table(const StudyPlan& plan,
                               const std::vector<BatchOutcome>& outcomes) {
  record::StudyTable table;
  table.title = "How far it is off its plan";
  table.caption =
      "True distance across the plan in metres: means over the seeds, ± their 95 % "
      "confidence interval.";
  table.columns = {"wind from", "flown", "plan", "RMS", "median",
                   "90 %",      "95 %",  "99 %", "most"};
  for (const StudyCell& cell : plan.cells) {
    std::vector<record::TableCell> row = {
        {cell.case_name}, {cell.estimator}, {cell.strategy}};
    for (const std::string& name :
         {std::string("cross_track_rms_m"), quantile_name(50), quantile_name(90),
          quantile_name(95), quantile_name(99), std::string("cross_track_max_m")}) {
      const MeanInterval value = figure_of(cell, outcomes, name);
      if (value.count == 0)
        row.push_back({std::numeric_limits<double>::quiet_NaN()});
      else
        row.push_back({figure_text(value, 2)});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

record::StudyTable ratio_table(const StudyPlan& plan,
                               const std::vector<BatchOutcome>& outcomes) {
  record::StudyTable table;
  table.title = "How many times closer trochoids are followed";
  table.caption = "95 % of the distances with Dubins plans over that with trochoids.";
  table.columns = {"wind from"};
  for (const Variant& manner : manners()) table.columns.push_back(manner.name);
  for (const std::string& wind : winds_of(plan)) {
    std::vector<record::TableCell> row = {{wind}};
    for (const Variant& manner : manners())
      row.push_back({fmt::format("{:.1f}", ratio_of(plan, outcomes, wind, manner.name))});
    table.rows.push_back(std::move(row));
  }
  return table;
}

// The share of the time for which it was no further off, over the distance.
record::StudyPlot distribution(const StudyPlan& plan,
                               const std::vector<BatchOutcome>& outcomes,
                               const std::string& manner) {
  record::StudyPlot plot;
  plot.title = "Distribution of the distance from the plan, flown " + manner;
  plot.x_label = "distance across the plan [m]";
  plot.y_label = "share of the time no further off";
  plot.y_low = 0;
  plot.y_high = 1;
  for (const StudyCell& cell : plan.cells) {
    if (cell.estimator != manner) continue;
    record::StudySeries series;
    series.name = cell.strategy + ", wind from " + cell.case_name;
    series.x.push_back(0);
    series.y.push_back(0);
    for (const int percent : percents()) {
      const MeanInterval value = figure_of(cell, outcomes, quantile_name(percent));
      if (value.count == 0) continue;
      series.x.push_back(value.mean);
      series.y.push_back(percent / 100.0);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

record::StudyMap flight_map(const StudyPlan& plan, const FollowingFlight& flight) {
  const StudyCell& cell = plan.cells[flight.cell];
  record::StudyMap map;
  map.title = fmt::format("Plan with {}, wind from {}, flown {}", cell.strategy,
                          cell.case_name, cell.estimator);
  map.caption = "First seed. Dashed: the plan where the aircraft was beside it.";
  record::StudySeries planned, flown;
  planned.name = "plan";
  planned.dashed = true;
  flown.name = "flown";
  for (const LapSample& s : flight.samples) {
    planned.x.push_back(s.on_route.y());
    planned.y.push_back(s.on_route.x());
    flown.x.push_back(s.position.y());
    flown.y.push_back(s.position.x());
  }
  map.series = {std::move(planned), std::move(flown)};
  return map;
}

}  // namespace

Result<StudyPlan> plan_following_study(const FollowingStudy& study,
                                       const ScenarioReader& reader) {
  const auto chosen = select(winds(), study.winds, "wind");
  if (!chosen) return chosen.error();
  VariantGrid grid;
  grid.base = study.base;
  grid.cases = chosen.value();
  grid.strategies = curves();
  grid.estimators = manners();
  grid.overrides = study.overrides;
  grid.first_seed = study.first_seed;
  grid.seeds = study.seeds;
  return plan_grid(grid, reader);
}

void add_following_figures(const std::vector<LapSample>& samples,
                           std::map<std::string, double>& figures) {
  std::vector<double> off;
  double square = 0;
  for (const LapSample& s : samples) {
    if (s.time < samples.front().time + kRunIn) continue;
    off.push_back(std::abs(s.cross_track));
    square += s.cross_track * s.cross_track;
  }
  if (off.empty()) return;
  std::sort(off.begin(), off.end());
  const double count = static_cast<double>(off.size());
  figures["cross_track_rms_m"] = std::sqrt(square / count);
  figures["cross_track_max_m"] = off.back();
  const auto quantile = [&](int percent) {
    const double at = std::ceil(count * percent / 100) - 1;
    figures[quantile_name(percent)] = off[static_cast<std::size_t>(std::max(at, 0.0))];
  };
  for (const int percent : percents()) quantile(percent);
}

record::StudyReport following_report(const FollowingStudy& study, const StudyPlan& plan,
                                     const std::vector<BatchOutcome>& outcomes,
                                     const std::vector<FollowingFlight>& shown) {
  record::StudyReport report;
  report.title = "Study: wind-following";
  report.intro = {fmt::format(
      "One aircraft flies through three waypoints, four laps, on plans of turns "
      "and "
      "straights: Dubins curves over ground, made as if there were no wind, and "
      "trochoids, "
      "made in the air mass with the wind as the autopilot believes it to be. {} seeds "
      "from {} on.",
      study.seeds, study.first_seed)};
  for (const Variant& manner : manners())
    report.intro.push_back(fmt::format("{}: {}.", manner.name, manner.help));
  report.tables = {ratio_table(plan, outcomes), error_table(plan, outcomes)};
  for (const Variant& manner : manners())
    report.plots.push_back(distribution(plan, outcomes, manner.name));
  for (const FollowingFlight& flight : shown)
    report.maps.push_back(flight_map(plan, flight));
  report.alert = partial_text(outcomes);
  report.notes = warnings_of(outcomes);
  return report;
}

std::map<std::string, double> following_ratios(
    const StudyPlan& plan, const std::vector<BatchOutcome>& outcomes) {
  std::map<std::string, double> ratios;
  for (const std::string& wind : winds_of(plan))
    for (const Variant& manner : manners())
      ratios[fmt::format("{}/{}/times_closer_p95", wind, manner.name)] =
          ratio_of(plan, outcomes, wind, manner.name);
  return ratios;
}

}  // namespace skein::campaign
