// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/network/network_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "skein/campaign/network/network_reference.h"

namespace skein::campaign {
namespace {

namespace figure = network_figure;

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// A reference of whatever experiment, in the units of the figures; NaN: not known.
struct NetworkReference {
  double delay_mean = kNotKnown, delay_p95 = kNotKnown, loss = kNotKnown,
         goodput = kNotKnown, collisions = kNotKnown, cpu = kNotKnown;
};

NetworkReference reference_of(NetworkExperiment experiment, const NetworkStudyCase& of) {
  switch (experiment) {
    case NetworkExperiment::kGrid:
      if (const auto grid = grid_reference(of.profile, of.rts, of.nodes))
        return {.delay_mean = grid->delay_mean_ms,
                .delay_p95 = grid->delay_p95_ms,
                .loss = 100 * grid->loss,
                .goodput = grid->goodput_kbps,
                .cpu = grid->cpu};
      break;
    case NetworkExperiment::kCell:
      if (const auto cell = cell_reference(of.rts, of.nodes))
        return {.goodput = cell->goodput_kbps,
                .collisions = cell->collisions,
                .cpu = cell->cpu};
      break;
    case NetworkExperiment::kHidden:
      if (const auto hidden = hidden_reference(of.profile, of.rts))
        return {.loss = 100 * (1 - hidden->delivered),
                .goodput = hidden->goodput_kbps,
                .cpu = hidden->cpu};
      break;
  }
  return {};
}

std::string access_of(bool rts) {
  return rts ? "RTS/CTS" : "basic access";
}

// A study with what has become of it.
struct FinishedNetworks {
  const NetworkStudy& study;
  const NetworkStudyPlan& planned;
  const std::vector<BatchOutcome>& outcomes;

  MeanInterval of(const StudyCell& cell, const char* name) const {
    return figure_of(cell, outcomes, name);
  }
  double mean(const StudyCell& cell, const char* name) const {
    const MeanInterval value = of(cell, name);
    return value.count > 0 ? value.mean : kNotKnown;
  }
  NetworkReference reference(const StudyCell& cell) const {
    return reference_of(study.experiment, planned.of(cell));
  }
  // The cells with this profile and access, by number of nodes.
  std::vector<const StudyCell*> row(const std::string& profile, bool rts) const {
    std::vector<const StudyCell*> cells;
    for (const StudyCell& cell : planned.plan.cells)
      if (planned.of(cell).profile == profile && planned.of(cell).rts == rts)
        cells.push_back(&cell);
    return cells;
  }
};

record::TableCell mean_text(const MeanInterval& value, int digits) {
  if (value.count == 0) return {kNotKnown};
  return {figure_text(value, digits)};
}

record::TableCell number_text(double value, int digits) {
  if (std::isnan(value)) return {kNotKnown};
  return {fmt::format("{:.{}f}", value, digits)};
}

double percent_off(double value, double reference) {
  return 100 * (value / reference - 1);
}

record::TableCell off_text(double percent) {
  if (!std::isfinite(percent)) return {kNotKnown};
  return {fmt::format("{:+.2f}", percent)};
}

record::StudyTable grid_table(const FinishedNetworks& done, const std::string& profile,
                              bool rts) {
  record::StudyTable table;
  table.title = fmt::format("{}, {}", profile, access_of(rts));
  table.columns = {"nodes", "mean delay [ms]", "ns-3",     "off [%]", "95 % within [ms]",
                   "ns-3",  "off [%]",         "loss [%]", "ns-3",    "goodput [kbit/s]",
                   "ns-3",  "off [%]"};
  for (const StudyCell* cell : done.row(profile, rts)) {
    const NetworkReference ns3 = done.reference(*cell);
    std::vector<record::TableCell> row = {{cell->estimator}};
    const auto add = [&](const char* name, double reference, int digits) {
      row.push_back(mean_text(done.of(*cell, name), digits));
      row.push_back(number_text(reference, digits));
    };
    const auto add_off = [&](const char* name, double reference) {
      row.push_back(off_text(percent_off(done.mean(*cell, name), reference)));
    };
    add(figure::kDelayMean, ns3.delay_mean, 3);
    add_off(figure::kDelayMean, ns3.delay_mean);
    add(figure::kDelayP95, ns3.delay_p95, 2);
    add_off(figure::kDelayP95, ns3.delay_p95);
    add(figure::kLoss, ns3.loss, 3);
    add(figure::kGoodput, ns3.goodput, 1);
    add_off(figure::kGoodput, ns3.goodput);
    table.rows.push_back(std::move(row));
  }
  return table;
}

record::StudyTable cell_table(const FinishedNetworks& done, const std::string& profile,
                              bool rts) {
  record::StudyTable table;
  table.title = fmt::format("Saturated cell, {}", access_of(rts));
  table.caption =
      "Off: Skein against Bianchi's model with the profile's retry limit, and against "
      "ns-3. Collisions: share of transmissions.";
  table.columns = {
      "stations", "goodput [kbit/s]", "Bianchi",        "with retry limit", "off [%]",
      "ns-3",     "off [%]",          "collisions [%]", "Bianchi",          "ns-3"};
  for (const StudyCell* cell : done.row(profile, rts)) {
    const NetworkReference ns3 = done.reference(*cell);
    const double goodput = done.mean(*cell, figure::kGoodput);
    const double finite = done.mean(*cell, figure::kBianchiFiniteGoodput);
    table.rows.push_back(
        {{cell->estimator},
         mean_text(done.of(*cell, figure::kGoodput), 1),
         number_text(done.mean(*cell, figure::kBianchiGoodput), 1),
         number_text(finite, 1),
         off_text(percent_off(goodput, finite)),
         number_text(ns3.goodput, 1),
         off_text(percent_off(goodput, ns3.goodput)),
         number_text(100 * done.mean(*cell, figure::kCollisions), 2),
         number_text(100 * done.mean(*cell, figure::kBianchiCollisions), 2),
         number_text(100 * ns3.collisions, 2)});
  }
  return table;
}

record::StudyTable hidden_table(const FinishedNetworks& done) {
  record::StudyTable table;
  table.title = "Two stations that send to one between them";
  table.caption =
      "With nn4 and nn8 the two do not hear each other; with cs91 they sense each other.";
  table.columns = {"profile",       "access", "goodput [kbit/s]", "ns-3", "off [%]",
                   "delivered [%]", "ns-3",   "off [points]"};
  for (const StudyCell& cell : done.planned.plan.cells) {
    const NetworkStudyCase& of = done.planned.of(cell);
    const NetworkReference ns3 = done.reference(cell);
    MeanInterval delivered = done.of(cell, figure::kLoss);
    delivered.mean = 100 - delivered.mean;
    table.rows.push_back(
        {{of.profile},
         {access_of(of.rts)},
         mean_text(done.of(cell, figure::kGoodput), 1),
         number_text(ns3.goodput, 1),
         off_text(percent_off(done.mean(cell, figure::kGoodput), ns3.goodput)),
         mean_text(delivered, 2),
         number_text(100 - ns3.loss, 2),
         off_text(ns3.loss - done.mean(cell, figure::kLoss))});
  }
  return table;
}

record::StudyTable network_cost_table(const FinishedNetworks& done) {
  record::StudyTable table;
  table.title = "What it costs";
  table.caption =
      "CPU time of the medium, start-up not counted, as measured when it ran. That of "
      "ns-3 was measured on another machine: the ratio is a rough one.";
  table.columns = {
      "profile",   "access",    "nodes", "CPU s a case", "CPU ms a simulated s",
      "ns-3 [ms]", "times less"};
  for (const StudyCell& cell : done.planned.plan.cells) {
    const double cpu = done.mean(cell, figure::kCpu);
    if (std::isnan(cpu)) continue;
    const double share = cpu / done.mean(cell, figure::kSimulated);
    const double ns3 = done.reference(cell).cpu;
    table.rows.push_back({{cell.case_name},
                          {access_of(done.planned.of(cell).rts)},
                          {cell.estimator},
                          number_text(cpu, 3),
                          number_text(1e3 * share, 3),
                          number_text(1e3 * ns3, 2),
                          number_text(ns3 / share, 0)});
  }
  return table;
}

// Of a figure against the number of nodes: a line with its interval for each profile.
record::StudyPlot network_plot(const FinishedNetworks& done, const char* name,
                               double scale, bool rts,
                               double NetworkReference::*reference,
                               const std::string& title, const std::string& unit) {
  record::StudyPlot plot;
  plot.title = fmt::format("{}, {}", title, access_of(rts));
  plot.caption =
      "Bands: 95 % intervals of the means over the seeds. Points: ns-3, where given.";
  plot.x_label = done.study.experiment == NetworkExperiment::kCell ? "stations" : "nodes";
  plot.y_label = unit;
  std::vector<record::StudySeries> references;
  for (const std::string& profile : done.study.profiles) {
    record::StudySeries line, points;
    line.name = profile;
    points.name = profile + ", ns-3";
    points.points = points.dashed = true;
    for (const StudyCell* cell : done.row(profile, rts)) {
      const MeanInterval value = done.of(*cell, name);
      const double x = done.planned.of(*cell).nodes;
      if (const double known = done.reference(*cell).*reference; !std::isnan(known)) {
        points.x.push_back(x);
        points.y.push_back(known * scale);
      }
      if (value.count == 0) continue;
      line.x.push_back(x);
      line.y.push_back(value.mean * scale);
      // No figure here is negative, though an interval may be.
      line.low.push_back(std::max(0.0, value.mean - value.half_width) * scale);
      line.high.push_back((value.mean + value.half_width) * scale);
    }
    plot.series.push_back(std::move(line));
    if (!points.x.empty()) references.push_back(std::move(points));
  }
  plot.series.insert(plot.series.end(), references.begin(), references.end());
  return plot;
}

// What the model says, as a line of comparison.
void add_model(const FinishedNetworks& done, const char* name, double scale, bool rts,
               record::StudyPlot& plot) {
  record::StudySeries line;
  line.name = "Bianchi";
  line.dashed = true;
  for (const StudyCell* cell : done.row(done.study.profiles.front(), rts)) {
    const double value = done.mean(*cell, name);
    if (std::isnan(value)) continue;
    line.x.push_back(done.planned.of(*cell).nodes);
    line.y.push_back(value * scale);
  }
  plot.series.push_back(std::move(line));
}

record::StudyDots network_dots(const FinishedNetworks& done, const std::string& title,
                               const std::string& label,
                               MeanInterval (*value)(const FinishedNetworks&,
                                                     const StudyCell&),
                               double (*known)(const NetworkReference&)) {
  record::StudyDots plot;
  plot.title = title;
  plot.caption = "Lines: 95 % intervals of the means over the seeds.";
  plot.x_label = label;
  plot.series = {"Skein", "ns-3"};
  for (const StudyCell& cell : done.planned.plan.cells) {
    const NetworkStudyCase& of = done.planned.of(cell);
    plot.rows.push_back(fmt::format("{}, {}", of.profile, access_of(of.rts)));
    const MeanInterval ours = value(done, cell);
    const double half = ours.count > 1 ? ours.half_width : kNotKnown;
    plot.dots.push_back(
        {{ours.count > 0 ? ours.mean : kNotKnown, ours.mean - half, ours.mean + half},
         {known(done.reference(cell)), kNotKnown, kNotKnown}});
  }
  return plot;
}

void add_grid(const FinishedNetworks& done, record::StudyReport& report) {
  report.title = "Study: radio network, grid";
  report.intro.push_back(fmt::format(
      "Nodes on a grid of 100 m; each sends five messages of 1000 bytes a second to its "
      "neighbours, {:.6g} s long. 802.11b at 2 Mbit/s, 2 GHz and 1 dBm, as in the thesis "
      "of Selecký, 6.4.3; profiles differ in thresholds: nn4 reaches the four nearest, "
      "nn8 the diagonal ones too, cs91 senses frames from 600 m.",
      done.study.duration));
  for (const std::string& profile : done.study.profiles)
    for (const bool rts : {false, true})
      report.tables.push_back(grid_table(done, profile, rts));
  for (const bool rts : {false, true}) {
    auto delay =
        network_plot(done, figure::kDelayMean, 1, rts, &NetworkReference::delay_mean,
                     "Mean delay", "mean delay [ms], logarithmic");
    auto slow =
        network_plot(done, figure::kDelayP95, 1, rts, &NetworkReference::delay_p95,
                     "95th percentile of delays", "delay [ms], logarithmic");
    delay.log_y = slow.log_y = true;
    report.plots.push_back(std::move(delay));
    report.plots.push_back(std::move(slow));
    report.plots.push_back(network_plot(done, figure::kLoss, 1, rts,
                                        &NetworkReference::loss, "Loss", "lost [%]"));
    report.plots.push_back(network_plot(done, figure::kGoodput, 1, rts,
                                        &NetworkReference::goodput, "Goodput",
                                        "goodput [kbit/s]"));
  }
}

void add_cell(const FinishedNetworks& done, record::StudyReport& report) {
  report.title = "Study: radio network, saturated cell";
  report.intro.push_back(fmt::format(
      "Stations that hear each other equally well and always have a message of 1000 "
      "bytes to send; 802.11b at 2 Mbit/s. {:.6g} s, of which the first does not count.",
      done.study.duration));
  for (const bool rts : {false, true}) {
    report.tables.push_back(cell_table(done, done.study.profiles.front(), rts));
    auto goodput =
        network_plot(done, figure::kGoodput, 1, rts, &NetworkReference::goodput,
                     "Goodput", "goodput [kbit/s]");
    add_model(done, figure::kBianchiFiniteGoodput, 1, rts, goodput);
    auto collisions =
        network_plot(done, figure::kCollisions, 100, rts, &NetworkReference::collisions,
                     "Collisions", "of transmissions [%]");
    add_model(done, figure::kBianchiCollisions, 100, rts, collisions);
    report.plots.push_back(std::move(goodput));
    report.plots.push_back(std::move(collisions));
  }
}

void add_hidden(const FinishedNetworks& done, record::StudyReport& report) {
  report.title = "Study: radio network, hidden node";
  report.intro.push_back(
      fmt::format("Three nodes in a row, 100 m apart; the outer two always have a "
                  "message of 1000 bytes for the middle one. {:.6g} s, of which the "
                  "first does not count.",
                  done.study.duration));
  report.tables.push_back(hidden_table(done));
  report.dots.push_back(network_dots(
      done, "Goodput", "goodput [kbit/s]",
      [](const FinishedNetworks& of, const StudyCell& cell) {
        return of.of(cell, figure::kGoodput);
      },
      [](const NetworkReference& ns3) { return ns3.goodput; }));
  report.dots.push_back(network_dots(
      done, "Delivered", "delivered [%]",
      [](const FinishedNetworks& of, const StudyCell& cell) {
        MeanInterval value = of.of(cell, figure::kLoss);
        value.mean = 100 - value.mean;
        return value;
      },
      [](const NetworkReference& ns3) { return 100 - ns3.loss; }));
}

}  // namespace

record::StudyReport network_report(const NetworkStudy& study,
                                   const NetworkStudyPlan& planned,
                                   const std::vector<BatchOutcome>& outcomes) {
  const FinishedNetworks done{study, planned, outcomes};
  record::StudyReport report;
  switch (study.experiment) {
    case NetworkExperiment::kGrid:
      add_grid(done, report);
      break;
    case NetworkExperiment::kCell:
      add_cell(done, report);
      break;
    case NetworkExperiment::kHidden:
      add_hidden(done, report);
      break;
  }
  report.intro.push_back(
      fmt::format("{} seeds from {} on; means over the seeds, ± their 95 % confidence "
                  "interval. Beside them means over up to three seeds of ns-3.37, a "
                  "packet-level simulator, for the same parameters with other traffic.",
                  study.seeds, study.first_seed));
  report.tables.push_back(network_cost_table(done));
  report.alert = partial_text(outcomes);
  report.notes = warnings_of(outcomes);
  return report;
}

std::map<std::string, double> network_comparison(
    const NetworkStudyPlan& planned, NetworkExperiment experiment,
    const std::vector<BatchOutcome>& outcomes) {
  std::map<std::string, double> figures;
  for (const StudyCell& cell : planned.plan.cells) {
    const NetworkReference ns3 = reference_of(experiment, planned.of(cell));
    const auto put = [&](const std::string& name, double value) {
      if (std::isfinite(value)) figures[cell.path() + "/" + name] = value;
    };
    const auto mean = [&](const char* name) {
      const MeanInterval value = figure_of(cell, outcomes, name);
      return value.count > 0 ? value.mean : kNotKnown;
    };
    put("delay_mean_off_percent", percent_off(mean(figure::kDelayMean), ns3.delay_mean));
    put("delay_p95_off_percent", percent_off(mean(figure::kDelayP95), ns3.delay_p95));
    put("goodput_off_percent", percent_off(mean(figure::kGoodput), ns3.goodput));
    put("loss_off_points", mean(figure::kLoss) - ns3.loss);
    put("bianchi_off_percent",
        percent_off(mean(figure::kGoodput), mean(figure::kBianchiFiniteGoodput)));
  }
  return figures;
}

}  // namespace skein::campaign
