// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/monitoring/monitoring_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

namespace skein::campaign {
namespace {

using record::StudyReport;
using record::StudyTable;

constexpr const char* kPerf = "perf_run_mean_m";
constexpr const char* kCoverage = "coverage_95_run_mean";
constexpr const char* kNees = "nees_run_mean";
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Finds cells and figures of a finished study.
class Figures {
 public:
  Figures(const StudyPlan& plan, const std::vector<BatchOutcome>& outcomes)
      : plan_(plan), outcomes_(outcomes) {}

  const StudyCell* cell(const std::string& case_name, const std::string& strategy,
                        const std::string& estimator) const {
    for (const StudyCell& each : plan_.cells)
      if (each.case_name == case_name && each.strategy == strategy &&
          each.estimator == estimator)
        return &each;
    return nullptr;
  }

  MeanInterval of(const StudyCell* cell, const char* figure) const {
    return cell ? figure_of(*cell, outcomes_, figure) : MeanInterval{};
  }

  /// Names in the order of the plan.
  std::vector<std::string> distinct(std::string StudyCell::*member) const {
    std::vector<std::string> names;
    for (const StudyCell& each : plan_.cells)
      if (std::find(names.begin(), names.end(), each.*member) == names.end())
        names.push_back(each.*member);
    return names;
  }

  const std::vector<StudyCell>& cells() const { return plan_.cells; }

 private:
  const StudyPlan& plan_;
  const std::vector<BatchOutcome>& outcomes_;
};

record::TableCell text_of(const MeanInterval& figure, int digits) {
  if (figure.count == 0) return {kNone};
  return {figure_text(figure, digits)};
}

// Rows: strategies; columns: estimators; of one figure in one case.
StudyTable table_of(const Figures& figures, const std::string& case_name,
                    const char* figure, const std::string& title, int digits,
                    bool mark_lowest) {
  StudyTable table;
  table.title = title;
  table.columns = {"strategy"};
  const auto estimators = figures.distinct(&StudyCell::estimator);
  for (const std::string& estimator : estimators) table.columns.push_back(estimator);
  double min = std::numeric_limits<double>::infinity();
  std::pair<std::size_t, std::size_t> best{0, 0};
  for (const std::string& strategy : figures.distinct(&StudyCell::strategy)) {
    std::vector<record::TableCell> row = {{strategy}};
    for (const std::string& estimator : estimators) {
      const MeanInterval value =
          figures.of(figures.cell(case_name, strategy, estimator), figure);
      row.push_back(text_of(value, digits));
      if (value.count > 0 && value.mean < min) {
        min = value.mean;
        best = {table.rows.size(), row.size() - 1};
      }
    }
    table.rows.push_back(std::move(row));
  }
  if (mark_lowest && best.second > 0)
    table.rows[best.first][best.second].highlight = true;
  return table;
}

// Perf of every strategy (rows) with every estimator, in one case.
record::StudyDots dots_of(const Figures& figures, const std::string& case_name) {
  record::StudyDots plot;
  plot.title = case_name + ": Perf";
  plot.caption =
      "Mean over the whole run and all seeds; lines: 95 % confidence interval.";
  plot.x_label = "Perf [m], logarithmic; further left is better";
  plot.log_x = true;
  plot.rows = figures.distinct(&StudyCell::strategy);
  plot.series = figures.distinct(&StudyCell::estimator);
  for (const std::string& strategy : plot.rows) {
    plot.dots.emplace_back();
    for (const std::string& estimator : plot.series) {
      const MeanInterval perf =
          figures.of(figures.cell(case_name, strategy, estimator), kPerf);
      const double half = perf.count > 1 ? perf.half_width : kNone;
      plot.dots.back().push_back(
          {perf.count > 0 ? perf.mean : kNone, perf.mean - half, perf.mean + half});
    }
  }
  return plot;
}

// The best of Skein's own against the fair benchmark and against the thesis.
StudyTable comparison(const Figures& figures) {
  StudyTable table;
  table.title = "Skein's best against the benchmarks";
  table.caption =
      "Perf, mean over the whole run and all seeds. Fair benchmark: tracking of the real "
      "edge with the binary sensor, points reset when crossed (tracking-binary, "
      "point-reset). Thesis: gus with qkf.";
  table.columns = {"case",           "Skein's best",  "Perf [m]",
                   "fair [m]",       "fair / best",   "gus+qkf [m]",
                   "gus+qkf / best", "coverage 95 %", "NEES"};
  for (const std::string& case_name : figures.distinct(&StudyCell::case_name)) {
    const StudyCell* best = nullptr;
    for (const StudyCell& cell : figures.cells())
      if (cell.case_name == case_name && !of_the_thesis(cell.estimator) &&
          figures.of(&cell, kPerf).count > 0 &&
          (!best || figures.of(&cell, kPerf).mean < figures.of(best, kPerf).mean))
        best = &cell;
    if (!best) continue;
    const double perf = figures.of(best, kPerf).mean;
    const auto fair =
        figures.of(figures.cell(case_name, "tracking-binary", "point-reset"), kPerf);
    const auto thesis = figures.of(figures.cell(case_name, "gus", "qkf"), kPerf);
    const auto ratio = [&](const MeanInterval& other) {
      return other.count ? other.mean / perf : kNone;
    };
    table.rows.push_back({{case_name},
                          {best->strategy + " + " + best->estimator},
                          text_of(figures.of(best, kPerf), 1),
                          text_of(fair, 1),
                          {ratio(fair)},
                          text_of(thesis, 1),
                          {ratio(thesis)},
                          text_of(figures.of(best, kCoverage), 3),
                          text_of(figures.of(best, kNees), 2)});
  }
  return table;
}

// All readings of the thesis's benchmark beside its own method.
StudyTable readings(const Figures& figures) {
  StudyTable table;
  table.title = "The thesis's claim and the readings of its benchmark";
  table.caption =
      "The claim: GUS with QKF beats periphery tracking. It is the benchmark over the "
      "method: above 1 the claim holds for that reading.";
  table.columns = {"case",
                   "gus + qkf [m]",
                   "(i) predicted edge [m]",
                   "(ii) binary edge [m]",
                   "(iii) ideal edge [m]",
                   "(i) / gus",
                   "(ii) / gus",
                   "(iii) / gus"};
  for (const std::string& case_name : figures.distinct(&StudyCell::case_name)) {
    const auto thesis = figures.of(figures.cell(case_name, "gus", "qkf"), kPerf);
    std::vector<record::TableCell> row = {{case_name}, text_of(thesis, 1)};
    std::vector<record::TableCell> ratios;
    bool any = thesis.count > 0;
    for (const char* reading :
         {"tracking-predicted", "tracking-binary", "tracking-ideal"}) {
      const auto value =
          figures.of(figures.cell(case_name, reading, "point-reset"), kPerf);
      any = any && value.count > 0;
      row.push_back(text_of(value, 1));
      ratios.push_back({value.count && thesis.count ? value.mean / thesis.mean : kNone});
    }
    row.insert(row.end(), ratios.begin(), ratios.end());
    if (any) table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

StudyReport monitoring_report(const MonitoringStudy& study, const StudyPlan& plan,
                              const std::vector<BatchOutcome>& outcomes) {
  const Figures figures(plan, outcomes);
  StudyReport report;
  report.title = "Study: monitoring";
  report.intro = {
      fmt::format(
          "Every estimator with every strategy in every case of wind and rate; {} "
          "seeds from {} on. Two aircraft, 20 m/s, turn radius 60 m, readings at "
          "1 Hz, 60 control points.",
          study.seeds, study.first_seed),
      "Perf is sqrt(mean(err^2 + sigma^2)) over the control points, in metres, as its "
      "mean "
      "over the whole run; ± is the 95 % confidence interval over the seeds. Smaller is "
      "better. Coverage is the share of the boundary inside the stated 95 % band; NEES "
      "is "
      "1 for a filter that knows how good it is."};
  if (auto table = comparison(figures); !table.rows.empty())
    report.tables.push_back(table);
  if (auto table = readings(figures); !table.rows.empty()) report.tables.push_back(table);
  for (const std::string& name : figures.distinct(&StudyCell::case_name)) {
    std::string help;
    for (const Variant& variant : monitoring_cases())
      if (variant.name == name) help = variant.help;
    StudyTable perf = table_of(figures, name, kPerf, name + ": Perf [m]", 1, true);
    perf.caption = help + ".";
    report.tables.push_back(std::move(perf));
    report.dots.push_back(dots_of(figures, name));
    report.tables.push_back(table_of(figures, name, kCoverage,
                                     name + ": coverage of the 95 % band", 2, false));
    report.tables.push_back(table_of(figures, name, kNees, name + ": NEES", 2, false));
  }
  report.alert = partial_text(outcomes);
  report.notes = warnings_of(outcomes);
  if (!report.alert.empty())
    report.notes.push_back(
        "Runs that failed or were not reached are missing: cells say n where it is less "
        "than asked for. Start the same study again to go on.");
  return report;
}

std::string runs_csv(const StudyPlan& plan, const std::vector<BatchOutcome>& outcomes) {
  std::set<std::string> names;
  for (const BatchOutcome& outcome : outcomes)
    if (outcome.summary)
      for (const auto& [name, value] : outcome.summary->numbers)
        if (!depends_on_machine(name)) names.insert(name);
  std::string csv;
  for (const std::string& dimension : plan.dimensions)
    if (!dimension.empty()) csv += dimension + ",";
  csv += "seed,content_hash";
  for (const std::string& name : names) csv += "," + name;
  csv += "\n";
  for (const StudyCell& cell : plan.cells)
    for (const std::size_t item : cell.items) {
      const auto& summary = outcomes[item].summary;
      if (!summary) continue;
      const std::array<const std::string*, 3> parts = {&cell.case_name, &cell.strategy,
                                                       &cell.estimator};
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (!plan.dimensions[k].empty()) csv += *parts[k] + ",";
      csv += fmt::format("{},{}", plan.items[item].scenario.seed, summary->content_hash);
      for (const std::string& name : names) {
        const auto value = summary->number(name);
        csv += value ? fmt::format(",{:.9g}", *value) : ",";
      }
      csv += "\n";
    }
  return csv;
}

}  // namespace skein::campaign
