// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/estimators/estimators_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/model/probability/range_rule.h"

namespace skein::campaign {

namespace {

using model::Moments;
using model::RangeRule;
using model::Side;

// N(0, 1) above `a` by Simpson's rule; 12 standard deviations hold all but 1e-32.
Moments integrate_above(double a) {
  const double start = std::max(a, 0.0), low = std::max(a, -12.0), high = start + 12;
  const int panels = 4000;
  const double h = (high - low) / panels;
  double m0 = 0, m1 = 0, m2 = 0;
  for (int k = 0; k <= panels; ++k) {
    const double t = low - start + k * h;
    const double end = k == 0 || k == panels ? 1 : k % 2 == 1 ? 4 : 2;
    const double weight = end * math::exp(-t * (start + t / 2));
    m0 += weight;
    m1 += weight * t;
    m2 += weight * t * t;
  }
  const double mean = m1 / m0;
  return {start + mean, m2 / m0 - mean * mean};
}

std::string column_name(RangeRule rule) {
  std::string name = range_rule_name(rule);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// Both tables, mean and variance, of one side.
void add_side(Side side, const EstimatorsStudyOptions& options,
              const std::vector<double>& bounds, std::vector<CurveTable>& tables) {
  const double sigma = options.sigma, sign = side == Side::kAbove ? 1 : -1;
  const std::string where = side == Side::kAbove ? "above" : "below";
  CurveTable mean{"mean_" + where,
                  "Mean of a range known to be " + where + " the bound",
                  {{"bound_m", bounds}}};
  CurveTable variance{"variance_" + where,
                      "Variance of a range known to be " + where + " the bound",
                      {{"bound_m", bounds}}};
  const auto add = [&](const std::string& name, auto&& moments) {
    mean.columns.push_back({name + "_m", {}});
    variance.columns.push_back({name + "_m2", {}});
    for (double bound : bounds) {
      const Moments m = moments(bound);
      mean.columns.back().values.push_back(m.mean);
      variance.columns.back().values.push_back(m.variance);
    }
  };
  // A bound from above is the mirror image of one from below.
  const auto mirrored = [&](const Moments& m) {
    return Moments{sign * sigma * m.mean, sigma * sigma * m.variance};
  };
  add("exact", [&](double b) { return mirrored(integrate_above(sign * b / sigma)); });
  for (RangeRule rule : model::kRangeRules)
    add(column_name(rule), [&](double b) {
      return correct_range(rule, 0, sigma * sigma, b, side, options.sigma_v);
    });
  for (const NamedUpdate& more : options.more)
    add(more.name, [&](double b) {
      return more.update(0, sigma * sigma, b, side, options.sigma_v);
    });
  tables.push_back(std::move(mean));
  tables.push_back(std::move(variance));
}

CurveTable gain_table(const EstimatorsStudyOptions& options,
                      const std::vector<double>& bounds) {
  const double variance = options.sigma * options.sigma;
  CurveTable table{
      "gain_a15",
      "Gain (A.15), range above the bound: claimed and true mean square error",
      {{"bound_m", bounds},
       {"exact_variance_m2", {}},
       {"claimed_variance_m2", {}},
       {"true_square_error_m2", {}}}};
  for (double bound : bounds) {
    const Moments exact = correct_range(RangeRule::kExact, 0, variance, bound,
                                        Side::kAbove, options.sigma_v);
    const Moments a15 = correct_range(RangeRule::kGainA15, 0, variance, bound,
                                      Side::kAbove, options.sigma_v);
    table.columns[1].values.push_back(exact.variance);
    table.columns[2].values.push_back(a15.variance);
    table.columns[3].values.push_back(model::second_moment(exact, a15.mean));
  }
  return table;
}

}  // namespace

void write_csv(const CurveTable& table, std::ostream& out) {
  std::string text;
  for (const Curve& column : table.columns)
    text += (text.empty() ? "" : ",") + column.name;
  text += '\n';
  const std::size_t rows = table.columns.empty() ? 0 : table.columns[0].values.size();
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
      // What is not finite does not exist: the cell stays empty.
      if (const double value = table.columns[j].values[i]; std::isfinite(value))
        text += fmt::format("{}", value);
      text += j + 1 < table.columns.size() ? ',' : '\n';
    }
  out << text;
}

std::vector<CurveTable> estimators_study(const EstimatorsStudyOptions& options) {
  SKEIN_CHECK(options.sigma > 0 && options.sigma_v > 0, options.sigma, options.sigma_v);
  SKEIN_CHECK(options.reach >= 0 && options.reach <= 30, options.reach);
  SKEIN_CHECK(options.steps >= 1, options.steps);
  std::vector<double> bounds;
  for (int k = 0; k <= options.steps; ++k)
    bounds.push_back(options.sigma * options.reach * (2.0 * k / options.steps - 1));
  std::vector<CurveTable> tables;
  add_side(Side::kAbove, options, bounds, tables);
  add_side(Side::kBelow, options, bounds, tables);
  tables.push_back(gain_table(options, bounds));
  return tables;
}

}  // namespace skein::campaign
