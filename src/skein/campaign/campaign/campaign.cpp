// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "skein/base/random.h"
#include "skein/campaign/batch/data_fingerprint.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/scenario_file.h"

namespace skein::campaign {
namespace {

// Every axis with the variants that are asked for.
Result<std::vector<Axis>> chosen_axes(const CampaignFile& file,
                                      const std::vector<std::string>& only) {
  std::vector<Axis> axes = file.axes;
  std::string known;
  for (const Axis& axis : axes)
    for (const Variant& variant : axis.variants) known += " " + variant.name;
  for (const std::string& name : only) {
    const bool there = std::any_of(axes.begin(), axes.end(), [&](const Axis& axis) {
      return std::any_of(axis.variants.begin(), axis.variants.end(),
                         [&](const Variant& v) { return v.name == name; });
    });
    if (!there)
      return Error{ErrorCode::kBadInput, name, "is no variant of this campaign.",
                   fmt::format("There are:{}.", known)};
  }
  for (Axis& axis : axes) {
    std::vector<Variant> kept;
    for (const Variant& variant : axis.variants)
      if (std::count(only.begin(), only.end(), variant.name) > 0) kept.push_back(variant);
    if (!kept.empty()) axis.variants = kept;
  }
  return axes;
}

std::vector<scenario::Override> drawn_values(const std::vector<DrawnKey>& draws,
                                             int seed) {
  std::vector<scenario::Override> drawn;
  for (std::size_t k = 0; k < draws.size(); ++k) {
    RandomStream random(static_cast<std::uint64_t>(seed), static_cast<std::uint32_t>(k),
                        Purpose::kStudy);
    const DrawnKey& each = draws[k];
    if (each.among.empty()) {
      drawn.push_back({fmt::format("{}={}", each.key,
                                   random.uniform(each.between[0], each.between[1]))});
      continue;
    }
    const auto count = static_cast<double>(each.among.size());
    const auto index = std::min(each.among.size() - 1,
                                static_cast<std::size_t>(random.uniform() * count));
    drawn.push_back({each.key + "=" + each.among[index]});
  }
  return drawn;
}

// One variant of each axis.
using Combination = std::vector<const Variant*>;

std::vector<Combination> combinations(const std::vector<Axis>& axes) {
  std::vector<Combination> all(1);
  for (const Axis& axis : axes) {
    std::vector<Combination> longer;
    for (const Combination& each : all)
      for (const Variant& variant : axis.variants) {
        longer.push_back(each);
        longer.back().push_back(&variant);
      }
    all = std::move(longer);
  }
  return all;
}

StudyCell cell_of(const Combination& combination) {
  StudyCell cell;
  const std::array<std::string*, 3> parts = {&cell.case_name, &cell.strategy,
                                             &cell.estimator};
  for (std::size_t k = 0; k < combination.size(); ++k) *parts[k] = combination[k]->name;
  return cell;
}

// The parts of a cell's path that the campaign has axes for.
std::vector<std::string> labels_of(const StudyCell& cell, std::size_t axes) {
  std::vector<std::string> labels = {cell.case_name, cell.strategy, cell.estimator};
  labels.resize(axes);
  return labels;
}

std::string heading_of(const CampaignFigure& figure) {
  return figure.heading.empty() ? figure.figure : figure.heading;
}

// A dash where there is nothing.
record::TableCell text_cell(bool there, std::string text) {
  record::TableCell cell;
  if (there)
    cell.value = std::move(text);
  else
    cell.value = std::nan("");
  return cell;
}

record::StudyTable campaign_table(const CampaignFile& file, const StudyPlan& plan,
                                  const std::vector<BatchOutcome>& outcomes) {
  record::StudyTable table;
  table.title = "Figures";
  table.caption = "Means over the runs, ± their 95 % confidence interval.";
  for (const Axis& axis : file.axes) table.columns.push_back(axis.name);
  table.columns.emplace_back("runs");
  for (const CampaignFigure& figure : file.figures) {
    table.columns.push_back(heading_of(figure));
    if (figure.extreme != Extreme::kNone)
      table.columns.emplace_back(figure.extreme == Extreme::kLeast ? "least" : "most");
  }
  for (const StudyCell& cell : plan.cells) {
    auto& row = table.rows.emplace_back();
    for (const std::string& label : labels_of(cell, file.axes.size()))
      row.push_back({label});
    row.push_back({static_cast<double>(
        std::count_if(cell.items.begin(), cell.items.end(),
                      [&](std::size_t item) { return outcomes[item].summary; }))});
    for (const CampaignFigure& figure : file.figures) {
      const MeanInterval mean = figure_of(cell, outcomes, figure.figure);
      row.push_back(text_cell(mean.count > 0, figure_text(mean, figure.digits)));
      if (figure.extreme == Extreme::kNone) continue;
      const FigureTally tally = tally_of(cell, outcomes, figure.figure);
      const double extreme = figure.extreme == Extreme::kLeast ? tally.min : tally.max;
      row.push_back(
          text_cell(tally.count > 0, fmt::format("{:.{}f}", extreme, figure.digits)));
    }
  }
  return table;
}

// Rows: all axes but the last; series: the last.
record::StudyDots campaign_dots(const CampaignFile& file, const CampaignFigure& figure,
                                const StudyPlan& plan,
                                const std::vector<BatchOutcome>& outcomes) {
  record::StudyDots plot;
  plot.title = heading_of(figure);
  plot.caption = "Means over the runs; lines: 95 % confidence interval.";
  plot.x_label = heading_of(figure);
  const auto index_in = [](std::vector<std::string>& all, const std::string& name) {
    const auto found = std::find(all.begin(), all.end(), name);
    if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
    all.push_back(name);
    return all.size() - 1;
  };
  constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::array<std::size_t, 2>> places;
  for (const StudyCell& cell : plan.cells) {
    std::vector<std::string> labels = labels_of(cell, file.axes.size());
    const std::string series = labels.back();
    labels.pop_back();
    places.push_back({index_in(plot.rows, fmt::format("{}", fmt::join(labels, ", "))),
                      index_in(plot.series, series)});
  }
  plot.dots.assign(
      plot.rows.size(),
      std::vector<record::StudyDot>(plot.series.size(), {kNoValue, kNoValue, kNoValue}));
  for (std::size_t k = 0; k < plan.cells.size(); ++k) {
    const MeanInterval mean = figure_of(plan.cells[k], outcomes, figure.figure);
    if (mean.count == 0) continue;
    const double half = mean.count > 1 ? mean.half_width : kNoValue;
    plot.dots[places[k][0]][places[k][1]] = {mean.mean, mean.mean - half,
                                             mean.mean + half};
  }
  return plot;
}

}  // namespace

Result<StudyPlan> plan_campaign(const CampaignFile& file, const CampaignOptions& options,
                                const ScenarioReader& reader) {
  const auto axes = chosen_axes(file, options.only);
  if (!axes) return axes.error();
  StudyPlan plan;
  plan.dimensions = {};
  for (std::size_t k = 0; k < axes.value().size(); ++k)
    plan.dimensions[k] = axes.value()[k].name;
  DataFingerprint data;
  for (const Combination& combination : combinations(axes.value())) {
    StudyCell cell = cell_of(combination);
    for (int k = 0; k < file.seeds; ++k) {
      const int seed = file.first_seed + k;
      std::vector<scenario::Override> overrides;
      for (const std::string& text : file.overrides) overrides.push_back({text});
      for (const Variant* variant : combination)
        for (const std::string& text : variant->overrides) overrides.push_back({text});
      for (scenario::Override& each : drawn_values(file.draws, seed))
        overrides.push_back(std::move(each));
      // Files that the campaign names are relative to it.
      for (scenario::Override& each : overrides) each.folder = file.source.folder;
      overrides.push_back({fmt::format("seed={}", seed)});
      for (const std::string& text : options.overrides) overrides.push_back({text});
      auto read = reader.read(file.scenario, overrides);
      const std::string path = cell.path();
      if (!read && read.error().code == ErrorCode::kInterrupted) return read.error();
      if (!read)
        return Error{ErrorCode::kBadInput,
                     fmt::format("campaign {}, variants {}, seed {}", file.name,
                                 path.empty() ? "none" : path, seed),
                     "\n" + read.error().text(), ""};
      scenario::Scenario run = std::move(read).value();
      run.name = fmt::format("{}{}{}", path, path.empty() ? "" : "/", seed);
      std::string text = scenario::write_scenario(run, reader.kinds());
      const auto files = data.of(scenario::named_files(run, reader.kinds()));
      if (!files) return files.error();
      cell.items.push_back(plan.items.size());
      plan.items.push_back({run.name, std::move(run), std::move(text), files.value()});
    }
    plan.cells.push_back(std::move(cell));
  }
  return plan;
}

std::vector<std::string> figures_that_nobody_has(
    const CampaignFile& file, const std::vector<BatchOutcome>& outcomes) {
  std::vector<std::string> all;
  const bool any =
      std::any_of(outcomes.begin(), outcomes.end(),
                  [](const BatchOutcome& o) { return o.summary.has_value(); });
  for (const CampaignFigure& figure : file.figures)
    if (any && std::none_of(outcomes.begin(), outcomes.end(), [&](const BatchOutcome& o) {
          return o.summary && o.summary->number(figure.figure).has_value();
        }))
      all.push_back(fmt::format("no run has the figure {}", figure.figure));
  return all;
}

record::StudyReport campaign_report(const CampaignFile& file, const StudyPlan& plan,
                                    const std::vector<BatchOutcome>& outcomes) {
  record::StudyReport report;
  report.title = "Campaign: " + file.name;
  report.intro = file.about;
  for (const Axis& axis : file.axes)
    for (const Variant& variant : axis.variants)
      if (!variant.help.empty())
        report.intro.push_back(
            fmt::format("{} {}: {}", axis.name, variant.name, variant.help));
  report.tables = {campaign_table(file, plan, outcomes)};
  if (!file.axes.empty())
    for (const CampaignFigure& figure : file.figures)
      report.dots.push_back(campaign_dots(file, figure, plan, outcomes));
  report.alert = partial_text(outcomes);
  report.notes = warnings_of(outcomes);
  const auto missing = figures_that_nobody_has(file, outcomes);
  report.notes.insert(report.notes.end(), missing.begin(), missing.end());
  return report;
}

}  // namespace skein::campaign
