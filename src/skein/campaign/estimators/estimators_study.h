// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "skein/model/probability/truncated_normal.h"

namespace skein::campaign {

/// A named series of numbers.
struct Curve {
  std::string name;  ///< with its unit, as in a CSV header
  std::vector<double> values;
};

/// One table of a study: one curve per column over the first column.
struct CurveTable {
  std::string name;   ///< short, for file names
  std::string title;  ///< for people
  std::vector<Curve> columns;
};

/// The table as CSV, numbers in the shortest form that reads back as the same double.
void write_csv(const CurveTable& table, std::ostream& out);

/// A measurement update that is given from outside, because it is more than a formula:
/// mean and variance of a range N(mean, variance) that is reported to be on one side of a
/// bound with standard deviation sigma_v.
struct NamedUpdate {
  std::string name;
  std::function<model::Moments(double mean, double variance, double bound,
                               model::Side side, double sigma_v)>
      update;
};

/// What `skein study estimators` sweeps.
struct EstimatorsStudyOptions {
  double sigma = 1;      ///< of the prior N(0, sigma^2) of the range [m], positive
  double sigma_v = 0.1;  ///< of the bound, for MLE, MAP and particles [m], positive
  double reach = 4;      ///< bounds run from -reach to +reach [sigma], 0 to 30
  int steps = 160;       ///< between the bounds, at least 1
  std::vector<NamedUpdate> more;  ///< further columns
};

/// Mean and variance of a range that is reported to be above or below a bound, against
/// the bound, as each estimator has them (thesis figures 2.6-2.9).
///
/// Tables `mean_above`, `variance_above`, `mean_below`, `variance_below`: column bound_m,
/// then exact (by numerical integration), qkf, mle, map, ukf, qkf_a15 and `more`. The
/// variance of an approximation is its second moment about the value it chose.
/// Table `gain_a15`: what the gain (A.15) claims for a bound from below, and the true
/// mean square error of its estimate. Fails: Bug when an option is out of its range.
/// Reference: [Rabinovich18] figures 2.6-2.9, Eq. (A.15).
std::vector<CurveTable> estimators_study(const EstimatorsStudyOptions& options);

}  // namespace skein::campaign
