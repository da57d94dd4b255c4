// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/tuning/tuning_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace skein::campaign {
namespace {

using record::TableCell;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// One row per set: means of some figures with their intervals.
class SetsTable {
 public:
  SetsTable(const TuningStudy& study, const TuningPlan& plan,
            const std::vector<BatchOutcome>& outcomes, std::string title)
      : plan_(plan), outcomes_(outcomes) {
    table_.title = std::move(title);
    table_.columns = {"gains"};
    for (const GainSet& set : study.sets) table_.rows.push_back({{set.name}});
  }

  void laps() {
    table_.columns.push_back("laps");
    for (std::size_t set = 0; set < table_.rows.size(); ++set) {
      const LapCount count = laps_of(plan_, outcomes_, set);
      table_.rows[set].push_back(
          {fmt::format("{} of {}", count.completed, count.planned)});
    }
  }

  // The minimum mean is highlighted when `lower_is_better`.
  void figure(const LapFigure& figure, bool lower_is_better) {
    table_.columns.push_back(figure.heading);
    double min = std::numeric_limits<double>::infinity();
    std::vector<double> means(table_.rows.size(), kNothing);
    for (std::size_t set = 0; set < means.size(); ++set) {
      const MeanInterval mean =
          mean_interval(values_of(plan_, outcomes_, set, figure.name));
      TableCell cell{kNothing};
      if (mean.count > 0) {
        cell.value = figure_text(mean, figure.digits);
        means[set] = mean.mean;
        min = std::min(min, mean.mean);
      }
      table_.rows[set].push_back(std::move(cell));
    }
    for (std::size_t set = 0; set < means.size(); ++set)
      table_.rows[set].back().highlight =
          lower_is_better && means.size() > 1 && means[set] == min;
  }

  record::StudyTable finish(std::string caption) {
    table_.caption = std::move(caption);
    return std::move(table_);
  }

 private:
  const TuningPlan& plan_;
  const std::vector<BatchOutcome>& outcomes_;
  record::StudyTable table_;
};

constexpr std::size_t kCrossTrack = 4;  // figures of it, the first of kLapFigures
constexpr std::size_t kOthers = 2;      // after them: height and airspeed

std::vector<record::StudyTable> sets_tables(const TuningStudy& study,
                                            const TuningPlan& plan,
                                            const std::vector<BatchOutcome>& outcomes) {
  SetsTable across(study, plan, outcomes, "Distance from the route");
  across.laps();
  for (std::size_t k = 0; k < kCrossTrack; ++k) across.figure(kLapFigures[k], true);
  SetsTable others(study, plan, outcomes, "Height, airspeed, effort");
  others.figure({"cost", "cost", 2}, true);
  for (std::size_t k = kCrossTrack; k < std::size(kLapFigures); ++k)
    others.figure(kLapFigures[k], k < kCrossTrack + kOthers);
  return {across.finish("Means over the flights, ± the 95 % confidence interval: true, "
                        "and as the autopilot believes it. Highlighted: the minimum."),
          others.finish("Height and airspeed: true ones less the demanded ones. Effort: "
                        "RMS of all surface rates together. Cost: see the notes.")};
}

record::StudyTable laps_table(const TuningStudy& study, const TuningPlan& plan,
                              const std::vector<BatchOutcome>& outcomes,
                              const std::vector<ShownFlight>& shown) {
  record::StudyTable table;
  table.title = "Lap by lap";
  table.columns = {"seed", "lap", "gains", "cost"};
  for (const LapFigure& figure : kLapFigures) table.columns.push_back(figure.heading);
  for (const ShownFlight& each : shown) {
    const TuningFlight& flight = plan.flights[each.flight];
    const auto& summary = outcomes[flight.item].summary;
    if (!summary) continue;
    for (std::size_t k = 0; k < flight.sets.size(); ++k) {
      const int lap = static_cast<int>(k);
      std::vector<TableCell> row = {
          {fmt::format("{}", plan.items[flight.item].scenario.seed)},
          {fmt::format("{}", lap + 1)},
          {study.sets[flight.sets[k]].name},
          {fmt::format("{:.2f}", lap_cost(*summary, lap))}};
      for (const LapFigure& figure : kLapFigures) {
        TableCell cell{kNothing};
        if (const auto value = lap_figure(*summary, lap, figure.name))
          cell.value = fmt::format("{:.{}f}", *value, figure.digits);
        row.push_back(std::move(cell));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

// What `x` and `y` make of each sample: one series per lap, or one per flight when its
// gains do not change.
template <class X, class Y>
std::vector<record::StudySeries> drawn(const TuningStudy& study, const TuningPlan& plan,
                                       const std::vector<ShownFlight>& shown, X x, Y y) {
  std::vector<record::StudySeries> all;
  for (const ShownFlight& each : shown) {
    const TuningFlight& flight = plan.flights[each.flight];
    int lap = -1;
    for (const LapSample& sample : each.samples) {
      if (sample.lap != lap && (lap < 0 || flight.changes())) {
        lap = sample.lap;
        const std::size_t set = flight.sets.at(static_cast<std::size_t>(lap));
        all.emplace_back().name =
            flight.changes() ? fmt::format("lap {}: {}", lap + 1, study.sets[set].name)
                             : study.sets[set].name;
      }
      all.back().x.push_back(x(sample));
      all.back().y.push_back(y(sample));
    }
  }
  return all;
}

void draw(const TuningStudy& study, const TuningPlan& plan,
          const std::vector<ShownFlight>& shown, record::StudyReport& report) {
  const std::string flown = fmt::format(
      "with seed {}", plan.items[plan.flights[shown.front().flight].item].scenario.seed);
  record::StudyPlot time;
  time.title = "Distance from the route";
  time.caption = fmt::format("True, right positive; flown {}.", flown);
  time.x_label = "time [s]";
  time.y_label = "cross-track [m]";
  time.levels = {{0, ""}};
  time.series = drawn(
      study, plan, shown, [](const LapSample& s) { return s.time; },
      [](const LapSample& s) { return s.cross_track; });
  report.plots.push_back(std::move(time));

  record::StudyMap map;
  map.title = "Ground track";
  map.caption = fmt::format("Dashed: the route, corners rounded; flown {}.", flown);
  map.series = drawn(
      study, plan, shown, [](const LapSample& s) { return s.position.y(); },
      [](const LapSample& s) { return s.position.x(); });
  record::StudySeries route;
  route.name = "route";
  route.dashed = true;
  for (const LapSample& sample : shown.front().samples) {
    if (sample.lap > 0) break;
    route.x.push_back(sample.on_route.y());
    route.y.push_back(sample.on_route.x());
  }
  map.series.push_back(std::move(route));
  report.maps.push_back(std::move(map));
}

std::string unfinished_text(const TuningStudy& study, const TuningPlan& plan,
                            const std::vector<BatchOutcome>& outcomes) {
  int planned = 0, completed = 0;
  for (std::size_t set = 0; set < study.sets.size(); ++set) {
    const LapCount laps = laps_of(plan, outcomes, set);
    planned += laps.planned;
    completed += laps.completed;
  }
  if (completed == planned) return {};
  return fmt::format(
      "{} of {} laps were not completed: the route was refused, an accident happened or "
      "duration_s is too short; see --log info.",
      planned - completed, planned);
}

}  // namespace

record::StudyReport tuning_report(const TuningStudy& study, const TuningPlan& plan,
                                  const std::vector<BatchOutcome>& outcomes,
                                  const std::vector<ShownFlight>& shown) {
  record::StudyReport report;
  report.title = "Study: tuning";
  const bool changes = plan.flights.front().changes();
  report.intro = {fmt::format(
      "A route of waypoints, {} laps. {}. Seeds {} to {}.",
      plan.flights.front().sets.size(),
      changes ? "Each lap is flown with other gains, and from one flight to the next the "
                "gains move on by a lap, so that each set is flown first, second and so "
                "on equally often"
              : "Each flight has the same gains in all laps",
      study.first_seed, study.first_seed + study.seeds - 1)};
  report.tables = sets_tables(study, plan, outcomes);
  if (!shown.empty()) {
    report.tables.push_back(laps_table(study, plan, outcomes, shown));
    draw(study, plan, shown, report);
  }
  report.alert = partial_text(outcomes);
  if (report.alert.empty()) report.alert = unfinished_text(study, plan, outcomes);
  report.notes = warnings_of(outcomes);
  report.notes.push_back(
      "Cost of a lap: (cross-track / 1 m)² + (height / 1 m)² + (airspeed / 1 m/s)² + "
      "(effort / 20 deg/s)², of true RMS values; 1000 when it was not completed.");
  return report;
}

namespace {

std::string search_text(const TuningSearch& search, const TuningFound& found,
                        const TuningStudy& study, const MeanInterval& change) {
  const auto& tries = found.search.tries;
  std::string text = fmt::format(
      "{} sets of gains were tried, each with seeds {} to {}: the cost went from {:.3f} "
      "to {:.3f}.",
      tries.size(), search.study.first_seed,
      search.study.first_seed + search.study.seeds - 1, tries.front().cost,
      found.search.best.cost);
  if (change.count > 0)
    text += fmt::format(
        " Flown with other seeds, {} to {}, which the search has not seen, the cost "
        "changes by {:.3f} ± {:.3f}: {}.",
        study.first_seed, study.first_seed + study.seeds - 1, change.mean,
        change.half_width,
        change.count > 1 && change.mean + change.half_width < 0
            ? "the gains found are better"
            : "no gain that would be certain");
  return text;
}

record::StudyTable found_table(const TuningSearch& search, const TuningFound& found) {
  record::StudyTable table;
  table.title = "Gains found";
  table.columns = {"gain", "start", "found", "ratio"};
  for (std::size_t k = 0; k < search.keys.size(); ++k) {
    const double now = found.search.best.at[k];
    table.rows.push_back({{search.keys[k]},
                          {fmt::format("{:.4g}", search.start[k])},
                          {fmt::format("{:.4g}", now)},
                          {fmt::format("{:.2f}", now / search.start[k])}});
  }
  return table;
}

record::StudyPlot search_plot(const std::vector<SimplexTry>& tries) {
  record::StudyPlot plot;
  plot.title = "Search";
  plot.caption = "Cost of each set of gains tried, and the best so far.";
  plot.x_label = "gains tried";
  plot.y_label = "cost";
  plot.log_y = true;
  record::StudySeries each, min;
  each.name = "tried";
  each.points = true;
  min.name = "best so far";
  double best = tries.front().cost;
  for (std::size_t k = 0; k < tries.size(); ++k) {
    best = std::min(best, tries[k].cost);
    for (auto* series : {&each, &min}) series->x.push_back(static_cast<double>(k + 1));
    each.y.push_back(tries[k].cost);
    min.y.push_back(best);
  }
  plot.series = {std::move(each), std::move(min)};
  return plot;
}

}  // namespace

void add_search(const TuningSearch& search, const TuningFound& found,
                const TuningStudy& study, const TuningPlan& plan,
                const std::vector<BatchOutcome>& outcomes, record::StudyReport& report) {
  if (found.search.tries.empty()) return;
  report.intro.push_back(search_text(search, found, study, cost_change(plan, outcomes)));
  report.tables.insert(report.tables.begin(), found_table(search, found));
  report.plots.insert(report.plots.begin(), search_plot(found.search.tries));
}

void add_search_figures(const TuningFound& found, const TuningPlan& plan,
                        const std::vector<BatchOutcome>& outcomes,
                        StudyFigures& figures) {
  const auto& tries = found.search.tries;
  figures["search/tried"] = static_cast<double>(tries.size());
  if (tries.empty()) return;
  figures["search/cost_start"] = tries.front().cost;
  figures["search/cost_found"] = found.search.best.cost;
  const MeanInterval change = cost_change(plan, outcomes);
  if (change.count > 0) figures["search/cost_change"] = change.mean;
  if (change.count > 1) figures["search/cost_change_ci95"] = change.half_width;
}

}  // namespace skein::campaign
