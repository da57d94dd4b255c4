#include "campaign/tuning_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::campaign {
namespace {

using record::StudyCell;

// The lower the better, for all but the last two of kLapFigures.
bool marks_best(std::size_t figure) {
  return figure < std::size(kLapFigures) - 2;
}

record::StudyTable sets_table(const TuningStudy& study, const TuningPlan& plan,
                              const std::vector<BatchOutcome>& outcomes) {
  record::StudyTable table;
  table.title = "Each set of gains";
  table.caption = fmt::format(
      "Means per lap over {} flights, ± the 95 % confidence interval. Cross-track is the "
      "distance from the route: true, and as the autopilot believes it. Height and "
      "airspeed are true ones less the demanded ones; effort is the RMS of all surface "
      "rates together. Highlighted: the best of each column.",
      plan.flights.size());
  table.columns = {"gains", "laps", "cost"};
  for (const LapFigure& figure : kLapFigures) table.columns.push_back(figure.heading);
  std::vector<double> best(table.columns.size(), std::numeric_limits<double>::infinity());
  std::vector<std::vector<double>> means;
  for (std::size_t set = 0; set < study.sets.size(); ++set) {
    std::vector<StudyCell> row = {{study.sets[set].name}};
    std::vector<double> values;
    const auto put = [&](const std::string& name, int digits, bool marks) {
      const auto all = values_of(plan, outcomes, set, name);
      const MeanInterval mean = mean_interval(all);
      if (mean.count == 0)
        row.push_back({std::numeric_limits<double>::quiet_NaN()});
      else
        row.push_back({figure_text(mean, digits)});
      const std::size_t column = row.size() - 1;
      values.resize(row.size(), std::numeric_limits<double>::infinity());
      if (mean.count > 0 && marks) {
        values[column] = mean.mean;
        best[column] = std::min(best[column], mean.mean);
      }
    };
    row.push_back({fmt::format("{} of {}",
                               values_of(plan, outcomes, set, kLapFigures[0].name).size(),
                               plan.flights.size())});
    put("cost", 2, true);
    for (std::size_t k = 0; k < std::size(kLapFigures); ++k)
      put(kLapFigures[k].name, kLapFigures[k].digits, marks_best(k));
    table.rows.push_back(std::move(row));
    means.push_back(std::move(values));
  }
  if (table.rows.size() > 1)
    for (std::size_t r = 0; r < table.rows.size(); ++r)
      for (std::size_t c = 2; c < table.columns.size(); ++c)
        table.rows[r][c].highlight = std::isfinite(best[c]) && means[r][c] == best[c];
  return table;
}

std::string lap_name(const TuningStudy& study, const TuningFlight& flight,
                     std::size_t lap) {
  return fmt::format("lap {}: {}", lap + 1, study.sets[flight.sets[lap]].name);
}

record::StudyTable laps_table(const TuningStudy& study, const TuningFlight& flight,
                              const std::string& flown,
                              const record::RunSummary& summary) {
  record::StudyTable table;
  table.title = "Lap by lap";
  table.caption = fmt::format("The flight {}.", flown);
  table.columns = {"lap", "gains", "cost"};
  for (const LapFigure& figure : kLapFigures) table.columns.push_back(figure.heading);
  for (std::size_t lap = 0; lap < flight.sets.size(); ++lap) {
    std::vector<StudyCell> row = {
        {fmt::format("{}", lap + 1)},
        {study.sets[flight.sets[lap]].name},
        {fmt::format("{:.2f}", lap_cost(summary, static_cast<int>(lap)))}};
    for (const LapFigure& figure : kLapFigures) {
      const auto value = summary.number(fmt::format("lap{}_{}", lap + 1, figure.name));
      if (value)
        row.push_back({fmt::format("{:.{}f}", *value, figure.digits)});
      else
        row.push_back({std::numeric_limits<double>::quiet_NaN()});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// One series per lap of what `x` and `y` make of each sample.
template <class X, class Y>
std::vector<record::StudySeries> by_lap(const TuningStudy& study,
                                        const TuningFlight& flight,
                                        const std::vector<LapSample>& samples, X x, Y y) {
  std::vector<record::StudySeries> series(flight.sets.size());
  for (std::size_t lap = 0; lap < series.size(); ++lap)
    series[lap].name = lap_name(study, flight, lap);
  for (const LapSample& sample : samples) {
    if (sample.lap >= static_cast<int>(series.size())) continue;
    auto& of_lap = series[static_cast<std::size_t>(sample.lap)];
    of_lap.x.push_back(x(sample));
    of_lap.y.push_back(y(sample));
  }
  return series;
}

}  // namespace

record::StudyReport tuning_report(const TuningStudy& study, const TuningPlan& plan,
                                  const std::vector<BatchOutcome>& outcomes,
                                  std::size_t shown,
                                  const std::vector<LapSample>& samples) {
  record::StudyReport report;
  report.title = "Study: tuning";
  report.intro = {fmt::format(
      "A route of waypoints, {} times round, each lap with other gains. {} seeds from {} "
      "on; from each to the next the sets of gains move on by a lap, so that each is "
      "flown first, second and so on equally often.",
      study.sets.size(), study.seeds, study.first_seed)};
  report.tables.push_back(sets_table(study, plan, outcomes));
  const TuningFlight& flight = plan.flights[shown];
  const std::string flown =
      fmt::format("with seed {}", plan.items[flight.item].scenario.seed);
  if (const auto& summary = outcomes[flight.item].summary)
    report.tables.push_back(laps_table(study, flight, flown, *summary));
  if (!samples.empty()) {
    record::StudyPlot time;
    time.title = "Distance from the route";
    time.caption = fmt::format("True, right positive; the flight {}.", flown);
    time.x_label = "time [s]";
    time.y_label = "cross-track [m]";
    time.series = by_lap(
        study, flight, samples, [](const LapSample& s) { return s.time; },
        [](const LapSample& s) { return s.cross_track; });
    time.levels = {{0, ""}};
    report.plots.push_back(std::move(time));
    record::StudyPlot map;
    map.title = "Ground track";
    map.caption = fmt::format("North up; the flight {}.", flown);
    map.x_label = "east [m]";
    map.y_label = "north [m]";
    map.series = by_lap(
        study, flight, samples, [](const LapSample& s) { return s.position.y(); },
        [](const LapSample& s) { return s.position.x(); });
    report.plots.push_back(std::move(map));
  }
  report.alert = partial_text(outcomes);
  report.notes = warnings_of(outcomes);
  report.notes.push_back(
      "Cost of a lap: (cross-track / 1 m)² + (height / 1 m)² + (airspeed / 1 m/s)² + "
      "(effort / 20 deg/s)², of RMS values; 1000 when it was not completed.");
  return report;
}

namespace {

// Found less start, one value per flight.
MeanInterval cost_change(const TuningPlan& plan,
                         const std::vector<BatchOutcome>& outcomes) {
  const auto start = values_of(plan, outcomes, 0, "cost");
  auto change = values_of(plan, outcomes, 1, "cost");
  for (std::size_t k = 0; k < change.size(); ++k) change[k] -= start[k];
  return mean_interval(change);
}

}  // namespace

void add_search(const TuningSearch& search, const TuningFound& found,
                const TuningStudy& study, const TuningPlan& plan,
                const std::vector<BatchOutcome>& outcomes, record::StudyReport& report) {
  const auto& tries = found.search.tries;
  if (tries.empty()) return;
  const MeanInterval change = cost_change(plan, outcomes);
  std::string text = fmt::format(
      "{} sets of gains were tried, each with seeds {} to {}: the cost went from {:.3f} "
      "to {:.3f}.",
      tries.size(), search.study.first_seed,
      search.study.first_seed + search.study.seeds - 1, tries.front().cost,
      found.search.best.cost);
  if (change.count > 0)
    text += fmt::format(
        " Flown with other seeds, {} to {}, which the search has not seen, the cost "
        "changes by {:.3f} ± {:.3f}{}.",
        study.first_seed, study.first_seed + study.seeds - 1, change.mean,
        change.half_width,
        change.mean + change.half_width < 0 ? ": the gains found are better"
                                            : ": no difference that would be certain");
  report.intro.push_back(std::move(text));

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
  report.tables.insert(report.tables.begin(), std::move(table));

  record::StudyPlot plot;
  plot.title = "Search";
  plot.caption = "Cost of each set of gains tried, and the least so far.";
  plot.x_label = "gains tried";
  plot.y_label = "cost";
  plot.log_y = true;
  record::StudySeries each{"tried", {}, {}, {}, {}, false, true};
  record::StudySeries least{"least so far", {}, {}, {}, {}, false, false};
  double best = tries.front().cost;
  for (std::size_t k = 0; k < tries.size(); ++k) {
    best = std::min(best, tries[k].cost);
    for (auto* series : {&each, &least}) series->x.push_back(static_cast<double>(k + 1));
    each.y.push_back(tries[k].cost);
    least.y.push_back(best);
  }
  plot.series = {std::move(each), std::move(least)};
  report.plots.insert(report.plots.begin(), std::move(plot));
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
  if (change.count == 0) return;
  figures["search/cost_change"] = change.mean;
  if (change.count > 1) figures["search/cost_change_ci95"] = change.half_width;
}

}  // namespace skein::campaign
