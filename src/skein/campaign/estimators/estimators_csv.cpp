// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/estimators/estimators_csv.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <ostream>
#include <utility>

#include "skein/base/csv.h"
#include "skein/model/probability/half_space_update.h"
#include "skein/model/probability/range_rule.h"

namespace skein::campaign {

namespace {

using model::Interval;
using model::Moments;
using model::Side;

// --- cases ---------------------------------------------------------------------------

struct Case {
  std::string kind;
  double mu = 0, sigma = 1;
  Interval bounds;
  std::optional<double> sigma_v, z_star;

  bool one_sided() const { return std::isinf(bounds.lower) != std::isinf(bounds.upper); }
  Side side() const { return std::isinf(bounds.upper) ? Side::kAbove : Side::kBelow; }
  double bound() const { return side() == Side::kAbove ? bounds.lower : bounds.upper; }
};

constexpr std::array<std::string_view, 5> kCaseColumns = {"kind", "mu", "sigma", "lower",
                                                          "upper"};

// A finite number, or a report.
std::optional<double> finite(CsvRow& row, std::string_view column) {
  const auto value = row.number(column);
  if (value && std::isinf(*value)) {
    row.report(column, "must be finite.");
    return std::nullopt;
  }
  return value;
}

std::optional<double> positive(CsvRow& row, std::string_view column,
                               std::optional<double> value) {
  if (value && !(*value > 0 && std::isfinite(*value))) {
    row.report(column, fmt::format("{} must be above 0 and finite.", *value));
    return std::nullopt;
  }
  return value;
}

std::optional<Case> read_case(CsvRow& row) {
  Case c;
  c.kind = row.text("kind");
  const auto mu = finite(row, "mu");
  const auto sigma = positive(row, "sigma", row.number("sigma"));
  const auto lower = row.number("lower"), upper = row.number("upper");
  const auto sigma_v = row.number_if_given("sigma_v");
  c.sigma_v = positive(row, "sigma_v", sigma_v);
  if (!mu || !sigma || !lower || !upper || sigma_v.has_value() != c.sigma_v.has_value())
    return std::nullopt;
  if (!(*lower < *upper)) {
    row.report("lower", fmt::format("{} must be below upper, {}.", *lower, *upper));
    return std::nullopt;
  }
  c.mu = *mu;
  c.sigma = *sigma;
  c.bounds = {*lower, *upper};
  return c;
}

// Whether the case has what the rules MLE and MAP need.
bool has_noisy_bound(CsvRow& row, const Case& c) {
  if (!c.one_sided())
    row.report("upper", c.kind + " needs one infinite and one finite bound.");
  else if (!c.sigma_v)
    row.report("sigma_v", c.kind + " needs a number here.");
  else
    return true;
  return false;
}

using Values = std::vector<double>;

Values evaluate_tn(const Case& c) {
  const model::TruncatedNormal cut = truncate_normal(c.mu, c.sigma, c.bounds);
  // The last term of (2.26) is 0 as printed.
  const double moved = cut.mean - c.mu;
  return {cut.mass, cut.mean, cut.variance, cut.variance + moved * moved};
}

// Second moment about z*, corrected and with the misprint "+ z*" for "+ z*^2", which is
// stated for a zero-mean prior.
Values evaluate_second_moment(const Case& c, double z_star) {
  const model::TruncatedNormal cut = truncate_normal(c.mu, c.sigma, c.bounds);
  const double moment = model::second_moment({cut.mean, cut.variance}, z_star);
  const double shifted = z_star - c.mu;
  return {z_star, moment, moment - shifted * shifted + shifted};
}

double map_of(const Case& c) {
  return model::map_value(c.mu, c.sigma, c.bound(), c.side(), *c.sigma_v);
}
double mle_of(const Case& c) {
  return model::mle_value(c.bound(), c.side(), *c.sigma_v);
}

std::optional<Values> evaluate_case(CsvRow& row, Case c,
                                    std::optional<double> last_sigma_v) {
  if (c.kind == "TN") return evaluate_tn(c);
  const model::SigmaPoints points = model::ukf_points(c.mu, c.sigma, c.bounds);
  if (c.kind == "UKF") return Values{points.low, points.high, points.mean()};
  if (c.kind == "COV_UKF") return evaluate_second_moment(c, points.mean());
  if (c.kind == "MAP") {
    if (!has_noisy_bound(row, c)) return std::nullopt;
    return Values{map_of(c), mle_of(c)};
  }
  if (c.kind == "COV_MLE" || c.kind == "COV_MAP") {
    if (!c.sigma_v) {
      const auto given = row.number_if_given("v1");
      if (given && std::isfinite(*given)) return evaluate_second_moment(c, *given);
      c.sigma_v = last_sigma_v;
    }
    if (!has_noisy_bound(row, c)) return std::nullopt;
    return evaluate_second_moment(c, c.kind == "COV_MLE" ? mle_of(c) : map_of(c));
  }
  row.report("kind",
             fmt::format("\"{}\" is none of TN, MAP, UKF, COV_MLE, COV_MAP, COV_UKF.",
                         c.kind.substr(0, 40)));
  return std::nullopt;
}

bool all_finite(CsvRow& row, const Values& values) {
  for (double value : values)
    if (!std::isfinite(value)) {
      row.report("", "the result is beyond the range of numbers.");
      return false;
    }
  return true;
}

// --- updates -------------------------------------------------------------------------

constexpr std::array<std::string_view, 19> kUpdateColumns = {
    "px",  "py",  "vx",  "vy",  "P00", "P01", "P02", "P03",         "P11",        "P12",
    "P13", "P22", "P23", "P33", "ux",  "uy",  "R",   "observed_in", "expected_in"};
constexpr std::string_view kUpdateResults =
    "lower,upper,mu_a,S,z_mean,z_var,px1,py1,vx1,vy1,Q00,Q01,Q02,Q03,Q11,Q12,Q13,Q22,Q23,"
    "Q33";

struct Update {
  model::ControlPoint point;
  Vec2 aircraft = Vec2::Zero();
  double noise = 0;
  Side side = Side::kAbove;
};

std::optional<Update> read_update(CsvRow& row) {
  std::array<double, kUpdateColumns.size()> v{};
  bool good = true;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto value = finite(row, kUpdateColumns[i]);
    good = good && value;
    v[i] = value.value_or(0);
  }
  if (!good) return std::nullopt;
  for (std::size_t i : {17u, 18u})
    if (v[i] != 0 && v[i] != 1) {
      row.report(kUpdateColumns[i], fmt::format("{} must be 0 or 1.", v[i]));
      return std::nullopt;
    }
  Update update;
  update.point.mean << v[0], v[1], v[2], v[3];
  std::size_t next = 4;
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j, ++next)
      update.point.covariance(i, j) = update.point.covariance(j, i) = v[next];
  update.aircraft = {v[14], v[15]};
  update.noise = v[16];
  update.side = model::side_of(v[17] == 1, v[18] == 1);
  if (update.noise < 0) {
    row.report("R", fmt::format("{} must not be negative.", update.noise));
    return std::nullopt;
  }
  // Relative to the largest: rounding of the printed numbers is no error.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(update.point.covariance,
                                                             Eigen::EigenvaluesOnly);
  if (!(eigen.eigenvalues().minCoeff() >=
        -1e-9 * eigen.eigenvalues().cwiseAbs().maxCoeff())) {
    row.report("P00", "P00..P33 is not a covariance: it has a negative eigenvalue.");
    return std::nullopt;
  }
  return update;
}

std::optional<Values> evaluate_update(CsvRow& row, Update update) {
  const model::LineOfSight seen = look_at(update.point, update.aircraft, update.noise);
  if (!(seen.range > 0)) {
    row.report("ux", "the aircraft is at the control point: there is no line of sight.");
    return std::nullopt;
  }
  if (!(seen.variance > 0)) {
    row.report("R", "the range is certain (S = 0): nothing can be learned.");
    return std::nullopt;
  }
  const Moments range =
      half_space_update(update.point, update.aircraft, update.noise, update.side);
  Values out = {seen.range, seen.variance, range.mean, range.variance};
  for (double x : update.point.mean) out.push_back(x);
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j) out.push_back(update.point.covariance(i, j));
  return out;
}

}  // namespace

std::vector<Error> evaluate_cases(std::string_view table, const std::string& name,
                                  std::ostream& out) {
  std::string text = "kind,mu,sigma,lower,upper,sigma_v,v1,v2,v3,v4\n";
  std::optional<double> last_sigma_v;
  std::vector<Error> problems = read_csv(table, name, {kCaseColumns}, [&](CsvRow& row) {
    const auto c = read_case(row);
    if (!c) return;
    if (c->sigma_v) last_sigma_v = c->sigma_v;
    const auto values = evaluate_case(row, *c, last_sigma_v);
    if (!values || !all_finite(row, *values)) return;
    text +=
        fmt::format("{},{},{},{},{},{}", c->kind, c->mu, c->sigma, c->bounds.lower,
                    c->bounds.upper, c->sigma_v ? fmt::format("{}", *c->sigma_v) : "");
    for (std::size_t i = 0; i < 4; ++i)
      text += i < values->size() ? fmt::format(",{}", (*values)[i]) : ",";
    text += '\n';
  });
  if (problems.empty()) out << text;
  return problems;
}

std::vector<Error> evaluate_updates(std::string_view table, const std::string& name,
                                    std::ostream& out) {
  std::string text =
      fmt::format("{},{}\n", fmt::join(kUpdateColumns, ","), kUpdateResults);
  std::vector<Error> problems = read_csv(table, name, {kUpdateColumns}, [&](CsvRow& row) {
    const auto update = read_update(row);
    if (!update) return;
    const auto values = evaluate_update(row, *update);
    if (!values || !all_finite(row, *values)) return;
    for (std::string_view column : kUpdateColumns)
      text += fmt::format("{},", row.text(column));
    text += update->side == Side::kAbove ? "0,inf" : "-inf,0";
    text += fmt::format(",{}\n", fmt::join(*values, ","));
  });
  if (problems.empty()) out << text;
  return problems;
}

}  // namespace skein::campaign
