// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/estimators/estimators_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein::campaign {
namespace {

struct Unit {
  const char* ending;  // of a column's name
  const char* label;   // of the axis
};
constexpr Unit kUnits[] = {{"_m2", "variance of the range [m²]"},
                           {"_m", "mean of the range [m]"}};

const Unit& unit_of(const Curve& column) {
  return column.name.ends_with(kUnits[0].ending) ? kUnits[0] : kUnits[1];
}

// "qkf_a15_m" is "qkf-a15" for people.
std::string legend_of(const Curve& column) {
  std::string name = column.name;
  name.resize(name.size() - std::string(unit_of(column).ending).size());
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

double largest(const record::StudySeries& series) {
  double max = 0;
  for (const double value : series.y) max = std::max(max, std::abs(value));
  return max;
}

// The y axis ends above the second-largest curve when the largest is far beyond it.
void limit_axis(record::StudyPlot& plot) {
  constexpr double kFar = 3;
  std::vector<std::pair<double, std::string>> sizes;
  for (const record::StudySeries& series : plot.series)
    sizes.emplace_back(largest(series), series.name);
  std::sort(sizes.rbegin(), sizes.rend());
  if (sizes.size() < 3 || sizes[0].first < kFar * sizes[1].first) return;
  plot.y_low = 0;
  plot.y_high = 1.1 * sizes[1].first;
  plot.caption = fmt::format("{} leaves the picture: up to {:.3g} m².", sizes[0].second,
                             sizes[0].first);
}

record::StudyPlot plot_of(const CurveTable& table, double sigma) {
  record::StudyPlot plot;
  plot.title = table.title;
  plot.x_label = fmt::format("bound [m] (sigma of the prior: {:g} m)", sigma);
  plot.y_label = unit_of(table.columns.back()).label;
  std::vector<record::StudySeries> exact;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    record::StudySeries series;
    series.name = legend_of(table.columns[c]);
    series.x = table.columns[0].values;
    series.y = table.columns[c].values;
    series.dashed = series.name.starts_with("exact");
    (series.dashed ? exact : plot.series).push_back(std::move(series));
  }
  const bool variances = plot.y_label == std::string(kUnits[0].label);
  plot.series.insert(plot.series.end(), exact.begin(), exact.end());
  if (variances) limit_axis(plot);
  return plot;
}

}  // namespace

record::StudyReport estimators_report(const std::vector<CurveTable>& tables,
                                      double sigma) {
  record::StudyReport report;
  report.title = "Study: estimators";
  report.intro = {
      fmt::format(
          "What one in/out reading teaches: a range with prior N(0, ({:g} m)²) is "
          "reported to be above, or below, a bound. Mean and variance after that, "
          "against the bound, for every measurement update (figures 2.6 to 2.9 of the "
          "thesis).",
          sigma),
      "exact: by numerical integration. The variance of an approximation is its second "
      "moment about the value that it chose: never below the exact one. particle: the "
      "estimator as shipped, 1,000 samples, no false readings; where too few samples "
      "remain it draws anew from the Gaussian update."};
  for (const CurveTable& table : tables) report.plots.push_back(plot_of(table, sigma));
  return report;
}

}  // namespace skein::campaign
