// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/boundary_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"
#include "skein/geo/vec.h"

namespace skein::perimeter {
namespace {

constexpr double kLongestLag = 5;    // of the covariance [s]
constexpr double kMaxTilt = 3;       // slope over radius, as tan: 72 degrees
constexpr double kMinShift = 0.02;   // of the covariance over the bearings [knots]
constexpr double kProductTime = 30;  // for which an error of wind times slope lasts [s]

// Share of harmonic k in the variance of a function, not normalised.
double share(const Roughness& roughness, int k) {
  // The mean is one number, every other harmonic is two.
  return (k == 0 ? 0.5 : 1) / (1 + math::pow(k / roughness.cutoff, roughness.fall));
}

// Adds the covariance of the spline's coefficients against their distance in knots, when
// harmonic k of the function has variance spectrum(k).
template <class Spectrum>
void add_covariance(const PeriodicSpline& spline, Spectrum&& spectrum,
                    Eigen::VectorXd& row) {
  const int n = spline.knots();
  for (int k = 0; k <= n / 2; ++k) {
    const double variance = spectrum(k) / math::squared(spline.response(k));
    if (!(variance > 0)) continue;
    for (int d = 0; d < n; ++d) row[d] += variance * math::cos(k * d * spline.step());
  }
}

double total_share(const PeriodicSpline& spline, const Roughness& roughness, int first) {
  double total = 0;
  for (int k = first; k <= spline.knots() / 2; ++k) total += share(roughness, k);
  return total;
}

}  // namespace

BoundaryFilter::BoundaryFilter(const PerimeterPrior& prior,
                               const BoundaryHypothesis& hypothesis, int knots,
                               int aircraft)
    : n_(knots),
      spline_(knots),
      hypothesis_(hypothesis),
      sites_(static_cast<std::size_t>(aircraft)) {
  const int unknowns = 2 + 2 * n_;
  x_.resize(unknowns);
  x_.head<2>() = prior.wind;
  x_.segment(r(0), n_).setConstant(prior.radius);
  x_.segment(v(0), n_).setConstant(prior.rate);

  radius_row_ = rate_row_ = Eigen::VectorXd::Zero(n_);
  const double radius_total = total_share(spline_, hypothesis.radius, 0);
  const double rate_total = total_share(spline_, hypothesis.rate, 1);
  add_covariance(
      spline_, [&](int k) { return share(hypothesis.radius, k) / radius_total; },
      radius_row_);
  add_covariance(
      spline_, [&](int k) { return k == 0 ? 0 : share(hypothesis.rate, k) / rate_total; },
      rate_row_);
  P_ = Eigen::MatrixXd::Zero(unknowns, unknowns);
  P_(0, 0) = P_(1, 1) = math::squared(hypothesis.wind_sd);
  add_circulant(r(0), radius_row_, math::squared(hypothesis.radius.sd));
  add_circulant(v(0), rate_row_, math::squared(hypothesis.rate.sd));
  P_.bottomRightCorner(n_, n_).array() += math::squared(hypothesis.mean_rate_sd);

  for (int j = 0; j < n_; ++j) e_r_.push_back(geo::unit(j * spline_.step()));
  Ph_.resize(unknowns);
  Ph_site_.resize(unknowns);
  drift_.resize(n_);
  trial_.resize(n_);
  padded_.resize(n_ + 4);
  advect_ = Eigen::VectorXd::Zero(n_);
  G_ = Eigen::MatrixXd::Zero(n_, 2);
  B_.resize(n_, n_);
}

// Adds gain * row to a diagonal block that depends on the distance of two knots only.
void BoundaryFilter::add_circulant(int from, const Eigen::VectorXd& row, double gain) {
  const bool rates = from == v(0);
  for (int i = 0; i < n_; ++i) {
    P_.col(from + i).segment(from + i, n_ - i).noalias() += gain * row.head(n_ - i);
    if (rates)
      P_.col(from + i).segment(from, i).noalias() += gain * row.segment(1, i).reverse();
  }
}

Vec2 BoundaryFilter::wind_effect(double bearing, double slope_over_radius) {
  const Vec2 e_r = geo::unit(bearing);
  return e_r -
         geo::turned_right(e_r) * std::clamp(slope_over_radius, -kMaxTilt, kMaxTilt);
}

BoundaryFilter::Local BoundaryFilter::at(double bearing) const {
  const PeriodicSpline::Tap tap = spline_.at(bearing);
  Local local;
  double rate = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    local.radius += tap.value[i] * x_[r(tap.index[i])];
    local.slope += tap.slope[i] * x_[r(tap.index[i])];
    rate += tap.value[i] * x_[v(tap.index[i])];
  }
  const Vec2 g =
      wind_effect(bearing, local.slope / std::max(local.radius, kMinPolarRadius));
  local.growth = rate + g.dot(wind());
  // r and its growth v + g.w from their few terms.
  for (std::size_t i = 0; i < 4; ++i) {
    const int ri = r(tap.index[i]), vi = v(tap.index[i]);
    const double a = tap.value[i];
    for (std::size_t j = 0; j < 4; ++j) {
      const int rj = r(tap.index[j]), vj = v(tap.index[j]);
      const double ab = a * tap.value[j];
      local.variance += ab * P_(std::max(ri, rj), std::min(ri, rj));
      local.covariance += ab * P_(vj, ri);
      local.growth_variance += ab * P_(vj, vi);
    }
    local.covariance += a * (g.x() * P_(ri, 0) + g.y() * P_(ri, 1));
    local.growth_variance += 2 * a * (g.x() * P_(vi, 0) + g.y() * P_(vi, 1));
  }
  local.growth_variance +=
      g.x() * g.x() * P_(0, 0) + 2 * g.x() * g.y() * P_(1, 0) + g.y() * g.y() * P_(1, 1);
  local.variance += lag_ * (2 * local.covariance + lag_ * local.growth_variance);
  local.covariance += lag_ * local.growth_variance;
  local.variance = std::max(local.variance, kMinVariance);
  local.growth_variance = std::max(local.growth_variance, 0.0);
  local.spline_variance = local.variance;
  local.variance += grounds()[0].noise;
  return local;
}

bool BoundaryFilter::sound() {
  constexpr double kFarthest = 1e6;  // [m]
  if (!std::exchange(changed_, false)) return true;
  // Sums, because a maximum would pass over what is not a number.
  return x_.cwiseAbs().sum() < kFarthest * n_ &&
         P_.diagonal().cwiseAbs().sum() < kFarthest * kFarthest;
}

// Growth of the radius coefficients `c`, of which padded_ gets a copy that goes on beyond
// the ends.
void BoundaryFilter::growth(const Eigen::Ref<const Eigen::VectorXd>& c, double moved) {
  padded_.segment(2, n_) = c;
  padded_.head<2>() = c.tail<2>();
  padded_.tail<2>() = c.head<2>();
  const double inverse_response = 1 / spline_.response(1);
  const double inverse_step = 1 / (12 * spline_.step());
  const Vec2 w = wind();
  // Near the origin a wind would turn points by many knots within one step of the
  // covariance, and the differences would no longer be stable.
  const double max_angular = 0.5 * spline_.step() / kLongestLag;
  for (int j = 0; j < n_; ++j) {
    const double* around = padded_.data() + j + 2;
    const double radius =
        std::max((around[-1] + 4 * around[0] + around[1]) / 6, kMinPolarRadius);
    const double slope =
        (8 * (around[1] - around[-1]) - (around[2] - around[-2])) * inverse_step;
    const Vec2& e_r = e_r_[static_cast<std::size_t>(j)];
    const Vec2 e_t = geo::turned_right(e_r);
    const double angular = std::clamp(e_t.dot(w) / radius, -max_angular, max_angular);
    const double tilt = std::clamp(slope / radius, -kMaxTilt, kMaxTilt);
    drift_[j] = x_[v(j)] + e_r.dot(w) * inverse_response - tilt * e_t.dot(w);
    if (moved > 0) {
      G_.row(j) = (e_r * inverse_response - e_t * tilt).transpose();
      advect_[j] += moved * angular;
    }
  }
}

// Heun step of the mean's coefficients. Leaves the wind's effect in G_ and adds the angle
// by which points were moved to advect_.
void BoundaryFilter::move_mean(double dt) {
  auto radius = x_.segment(r(0), n_);
  growth(radius, dt);
  trial_ = radius + dt * drift_;
  radius += 0.5 * dt * drift_;
  growth(trial_, 0);
  radius += 0.5 * dt * drift_;
}

void BoundaryFilter::predict(double dt) {
  while (dt > 0) {
    changed_ = true;
    const double step = std::min(dt, kLongestLag - lag_);
    dt -= step;
    age_ += step;
    lag_ += step;
    const int substeps = static_cast<int>(std::ceil(step));
    for (int i = 0; i < substeps; ++i) move_mean(step / substeps);
    if (lag_ >= kLongestLag) settle();
    for (Site& site : sites_) site.age += step;
  }
}

// P <- F P F' + Q over the lag, with u = v + G w the growth of r.
void BoundaryFilter::settle() {
  if (!(lag_ > 0)) return;
  changed_ = true;
  const double dt = lag_;
  lag_ = 0;
  const auto w_v = P_.block(v(0), 0, n_, 2);  // cov(v, w), a column per axis
  for (int i = 0; i < n_; ++i) {
    auto v_r = P_.col(r(i)).segment(v(0), n_);
    // Twice half a step; r with r half-way in between makes the quadratic term exact.
    const double gx = G_(i, 0), gy = G_(i, 1), half = 0.5 * dt;
    const double x_change = half * (P_(v(i), 0) + gx * P_(0, 0) + gy * P_(1, 0));
    const double y_change = half * (P_(v(i), 1) + gx * P_(1, 0) + gy * P_(1, 1));
    drift_.noalias() = half * P_.col(v(i)).segment(v(0), n_) + (half * gx) * w_v.col(0) +
                       (half * gy) * w_v.col(1);
    B_.col(i).noalias() = v_r + drift_ + (P_(r(i), 0) + x_change) * G_.col(0) +
                          (P_(r(i), 1) + y_change) * G_.col(1);
    v_r.noalias() += 2 * drift_;
    P_(r(i), 0) += 2 * x_change;
    P_(r(i), 1) += 2 * y_change;
  }
  for (int i = 0; i < n_; ++i) {
    P_.col(r(i)).segment(r(i), n_ - i).noalias() +=
        dt * (B_.col(i).tail(n_ - i) + B_.row(i).tail(n_ - i).transpose());
  }
  advect_covariance();
  noise_due_ += dt;
  if (noise_due_ >= kLongestLag) {
    const double rate_noise = hypothesis_.rate_drift * hypothesis_.rate_drift;
    if (rate_noise > 0) add_circulant(v(0), rate_row_, noise_due_ * rate_noise);
    const double radius_noise = product_noise();
    if (radius_noise > 0) add_circulant(r(0), radius_row_, noise_due_ * radius_noise);
    noise_due_ = 0;
  }
}

// Intensity of the noise [m^2/s] that stands for the product of the errors of wind and
// slope, which the linearisation drops: its variance, averaged over the bearings, taken
// to last for kProductTime.
double BoundaryFilter::product_noise() const {
  double sum = 0;
  for (int j = 0; j < n_; ++j) {
    const int a = r((j + n_ - 1) % n_), b = r((j + 1) % n_);
    const double slope = (P_(a, a) + P_(b, b) - 2 * P_(std::max(a, b), std::min(a, b))) /
                         math::squared(2 * spline_.step());
    const Vec2 e_t = geo::turned_right(e_r_[static_cast<std::size_t>(j)]);
    const double tangential = e_t.x() * e_t.x() * P_(0, 0) +
                              2 * e_t.x() * e_t.y() * P_(1, 0) +
                              e_t.y() * e_t.y() * P_(1, 1);
    // Beyond a tilt of 45 degrees the noise would feed on the slopes that it makes.
    const double tilt2 = slope / math::squared(std::max(x_[r(j)], kMinPolarRadius));
    sum += tangential * std::min(tilt2, 1.0);
  }
  return 2 * kProductTime * sum / n_;
}

// P_rr <- A P_rr A', and A likewise wherever r stands, with A = I - advect d/dbearing.
// Waits until the shift is worth the work.
void BoundaryFilter::advect_covariance() {
  const double scale = 1 / spline_.step();
  if (advect_.cwiseAbs().maxCoeff() * scale < kMinShift) return;
  const auto wrapped = [this](int j) { return j < 0 ? j + n_ : (j < n_ ? j : j - n_); };
  const auto shift_columns = [&](auto&& M) {
    B_ = M;
    for (int j = 0; j < n_; ++j) {
      const double a = -advect_[j] * scale / 12;
      M.col(j).noalias() += (8 * a) * (B_.col(wrapped(j + 1)) - B_.col(wrapped(j - 1))) -
                            a * (B_.col(wrapped(j + 2)) - B_.col(wrapped(j - 2)));
    }
  };
  auto rr = P_.block(r(0), r(0), n_, n_);
  for (int i = 0; i < n_; ++i)
    rr.row(i).tail(n_ - i) = rr.col(i).tail(n_ - i).transpose();
  shift_columns(rr);
  rr.transposeInPlace();
  shift_columns(rr);
  shift_columns(P_.block(v(0), r(0), n_, n_));
  for (int axis = 0; axis < 2; ++axis) {
    auto r_w = P_.col(axis).segment(r(0), n_);
    drift_ = r_w;
    for (int j = 0; j < n_; ++j) {
      r_w[j] -= advect_[j] * scale / 12 *
                (8 * (drift_[wrapped(j + 1)] - drift_[wrapped(j - 1)]) -
                 (drift_[wrapped(j + 2)] - drift_[wrapped(j - 2)]));
    }
  }
  advect_.setZero();
}

}  // namespace skein::perimeter
