#include "layer/reasoning/monitoring/joint/boundary_filter.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "geo/vec.h"
#include "layer/reasoning/monitoring/joint/step_likelihood.h"
#include "model/probability/truncated_normal.h"

namespace skein::monitoring {
namespace {

constexpr double kLeastRadius = 20;  // the polar frame ends here [m]
constexpr double kNoiseStep = 5;     // longest time between noise and advection [s]
constexpr double kSiteLife = 60;     // a bound older than this stays for good [s]
constexpr double kSamePlace = 0.9;   // correlation from which two bounds are one
constexpr int kSureCount = 4;        // so many agreeing readings are not all false
constexpr double kBump = 0.25;       // width of what widen() opens [rad]
constexpr double kObvious = 3.2;     // readings this many sigma off teach nothing

// Covariance of the spline's coefficients against their distance in knots, with unit
// variance of the function at the knots.
Eigen::VectorXd covariance_row(const PeriodicSpline& spline, const Roughness& roughness,
                               bool with_mean) {
  const int n = spline.knots();
  Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
  double total = 0;
  for (int k = with_mean ? 0 : 1; k <= n / 2; ++k) {
    const double variance = 1 / (1 + std::pow(k / roughness.cutoff, 6));
    total += variance;
    const double response = spline.response(k);
    for (int d = 0; d < n; ++d) {
      row[d] += variance / (response * response) * std::cos(k * d * spline.step());
    }
  }
  return row / total;
}

}  // namespace

BoundaryFilter::BoundaryFilter(const PerimeterPrior& prior,
                               const BoundaryHypothesis& hypothesis, int knots,
                               int aircraft)
    : n_(knots),
      spline_(knots),
      hypothesis_(hypothesis),
      sites_(static_cast<std::size_t>(aircraft)) {
  const int unknowns = 2 * n_ + 2;
  x_.resize(unknowns);
  x_.head(n_).setConstant(prior.radius);
  x_.segment(n_, n_).setConstant(prior.rate);
  x_.tail<2>() = prior.wind;
  radius_row_ = covariance_row(spline_, hypothesis.radius, true);
  rate_row_ = covariance_row(spline_, hypothesis.rate, false);
  P_ = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (int i = 0; i < n_; ++i) {
    for (int j = i; j < n_; ++j) {
      P_(j, i) = std::pow(hypothesis.radius.sd, 2) * radius_row_[j - i];
      P_(n_ + j, n_ + i) = std::pow(hypothesis.rate.sd, 2) * rate_row_[j - i] +
                           std::pow(hypothesis.mean_rate_sd, 2);
    }
  }
  P_(2 * n_, 2 * n_) = P_(2 * n_ + 1, 2 * n_ + 1) = std::pow(prior.wind_sd, 2);
  for (int j = 0; j < n_; ++j) e_r_.push_back(geo::unit(j * spline_.step()));
  Ph_.resize(unknowns);
  Ph_site_.resize(unknowns);
  drift_.resize(n_);
  trial_.resize(n_);
  advect_ = Eigen::VectorXd::Zero(n_);
  G_.resize(n_, 2);
  shifted_.resize(n_, n_);
}

// --- linear functions of the state
// -------------------------------------------------------

BoundaryFilter::Functional BoundaryFilter::radius_at(
    const PeriodicSpline::Tap& tap) const {
  Functional h;
  for (std::size_t i = 0; i < 4; ++i) h.add(tap.index[i], tap.value[i]);
  return h;
}

Vec2 BoundaryFilter::wind_effect(double bearing, double slope_over_radius) const {
  const Vec2 e_r = geo::unit(bearing);
  return e_r - geo::turned_right(e_r) * slope_over_radius;
}

// The radius `age` seconds ago, carried back at the present rates.
BoundaryFilter::Functional BoundaryFilter::aged_radius_at(double bearing,
                                                          double age) const {
  const PeriodicSpline::Tap tap = spline_.at(bearing);
  Functional h = radius_at(tap);
  double radius = 0, slope = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    h.add(n_ + tap.index[i], -age * tap.value[i]);
    radius += tap.value[i] * x_[tap.index[i]];
    slope += tap.slope[i] * x_[tap.index[i]];
  }
  const Vec2 g = wind_effect(bearing, slope / std::max(radius, kLeastRadius));
  h.add(2 * n_, -age * g.x());
  h.add(2 * n_ + 1, -age * g.y());
  return h;
}

double BoundaryFilter::dot(const Functional& h, const Eigen::VectorXd& v) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(h.size); ++i)
    sum += h.weight[i] * v[h.index[i]];
  return sum;
}

// Ph = P h; returns h' P h.
double BoundaryFilter::apply(const Functional& h, Eigen::VectorXd& Ph) const {
  Ph.setZero();
  const Eigen::Index n = P_.rows();
  for (std::size_t i = 0; i < static_cast<std::size_t>(h.size); ++i) {
    const Eigen::Index j = h.index[i];
    Ph.head(j).noalias() += h.weight[i] * P_.row(j).head(j).transpose();
    Ph.tail(n - j).noalias() += h.weight[i] * P_.col(j).tail(n - j);
  }
  return dot(h, Ph);
}

void BoundaryFilter::correct(const Eigen::VectorXd& Ph, double mean_gain,
                             double variance_gain) {
  x_.noalias() += mean_gain * Ph;
  correct_covariance(Ph, variance_gain);
}

// P += gain * column * column'.
void BoundaryFilter::correct_covariance(const Eigen::VectorXd& column, double gain) {
  const Eigen::Index n = P_.rows();
  for (Eigen::Index j = 0; j < n; ++j) {
    P_.col(j).tail(n - j).noalias() += (gain * column[j]) * column.tail(n - j);
  }
}

BoundaryFilter::Local BoundaryFilter::at(double bearing) const {
  const PeriodicSpline::Tap tap = spline_.at(bearing);
  Local local;
  double v = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    local.radius += tap.value[i] * x_[tap.index[i]];
    local.slope += tap.slope[i] * x_[tap.index[i]];
    v += tap.value[i] * x_[n_ + tap.index[i]];
  }
  const Vec2 g = wind_effect(bearing, local.slope / std::max(local.radius, kLeastRadius));
  local.growth = v + g.dot(wind());
  // r and u = v + g.w from their few terms.
  const auto symmetric = [this](int a, int b) { return a >= b ? P_(a, b) : P_(b, a); };
  const int w = 2 * n_;
  for (std::size_t i = 0; i < 4; ++i) {
    const int a = tap.index[i];
    const double ri = tap.value[i];
    for (std::size_t j = 0; j < 4; ++j) {
      const int b = tap.index[j];
      const double rj = tap.value[j];
      local.variance += ri * rj * symmetric(a, b);
      local.covariance += ri * rj * P_(n_ + b, a);
      local.growth_variance += ri * rj * symmetric(n_ + a, n_ + b);
    }
    local.covariance += ri * (g.x() * P_(w, a) + g.y() * P_(w + 1, a));
    local.growth_variance += 2 * ri * (g.x() * P_(w, n_ + a) + g.y() * P_(w + 1, n_ + a));
  }
  local.growth_variance += g.x() * g.x() * P_(w, w) + 2 * g.x() * g.y() * P_(w + 1, w) +
                           g.y() * g.y() * P_(w + 1, w + 1);
  const double texture = hypothesis_.texture_rate * age_;
  local.variance += texture * texture;
  return local;
}

// --- prediction
// ----------------------------------------------------------------------------

namespace {

// Fourth-order difference of periodic samples, times the spacing.
template <class Get>
double periodic_slope(int j, int n, Get&& get) {
  return (8 * (get((j + 1) % n) - get((j + n - 1) % n)) -
          (get((j + 2) % n) - get((j + n - 2) % n))) /
         12;
}

}  // namespace

// Heun step of the mean's coefficients; leaves the angular speed w.e_t/r in advect_ and
// the wind's effect in G_.
void BoundaryFilter::move_mean(double dt) {
  const double response = spline_.response(1);
  const auto rate = [&](const auto& c, Eigen::VectorXd& out, bool keep) {
    for (int j = 0; j < n_; ++j) {
      const double radius =
          std::max((c[(j + n_ - 1) % n_] + 4 * c[j] + c[(j + 1) % n_]) / 6, kLeastRadius);
      const double slope =
          periodic_slope(j, n_, [&](int i) { return c[i]; }) / spline_.step();
      const Vec2& e_r = e_r_[static_cast<std::size_t>(j)];
      const Vec2 g = e_r / response - geo::turned_right(e_r) * (slope / radius);
      out[j] = x_[n_ + j] + g.dot(wind());
      if (keep) {
        G_.row(j) = g.transpose();
        advect_[j] += dt * geo::turned_right(e_r).dot(wind()) / radius;
      }
    }
  };
  rate(x_, drift_, true);
  trial_ = x_.head(n_) + dt * drift_;
  x_.head(n_) += 0.5 * dt * drift_;
  rate(trial_, drift_, false);
  x_.head(n_) += 0.5 * dt * drift_;
}

// P_rr, P_rv, P_rw under the angular shift gathered in advect_ [rad].
void BoundaryFilter::advect_covariance() {
  const double scale = 1 / spline_.step();
  if (advect_.cwiseAbs().maxCoeff() * scale < 1e-6) {
    advect_.setZero();
    return;
  }
  // Columns first: rows r of P against everything; P_vr and P_wr are columns r.
  auto lower = P_.bottomLeftCorner(n_ + 2, n_);
  auto rr = P_.topLeftCorner(n_, n_);
  const auto shift_columns = [&](auto&& M, Eigen::Index rows, auto&& buffer) {
    buffer = M;
    for (int j = 0; j < n_; ++j) {
      const double a = -advect_[j] * scale / 12;
      M.col(j).noalias() +=
          (8 * a) * (buffer.col((j + 1) % n_) - buffer.col((j + n_ - 1) % n_)) -
          a * (buffer.col((j + 2) % n_) - buffer.col((j + n_ - 2) % n_));
    }
    (void)rows;
  };
  rr.triangularView<Eigen::StrictlyUpper>() = rr.transpose();
  shift_columns(rr, n_, shifted_);
  rr.transposeInPlace();
  shift_columns(rr, n_, shifted_);
  auto vr = P_.block(n_, 0, n_, n_);
  shift_columns(vr, n_, shifted_);
  auto wr = P_.block(2 * n_, 0, 2, n_);
  auto buffer = shifted_.topRows(2);
  shift_columns(wr, 2, buffer);
  (void)lower;
  advect_.setZero();
}

void BoundaryFilter::add_noise(double dt) {
  const double q_rate = hypothesis_.rate_drift * hypothesis_.rate_drift * dt;
  const double q_radius = hypothesis_.radius_drift * hypothesis_.radius_drift * dt;
  if (q_rate > 0) {
    for (int i = 0; i < n_; ++i) {
      P_.col(n_ + i).segment(n_ + i, n_ - i).noalias() += q_rate * rate_row_.head(n_ - i);
    }
  }
  if (q_radius > 0) {
    for (int i = 0; i < n_; ++i) {
      P_.col(i).segment(i, n_ - i).noalias() += q_radius * radius_row_.head(n_ - i);
    }
  }
}

void BoundaryFilter::predict(double dt) {
  while (dt > 0) {
    const double step = std::min(dt, kNoiseStep);
    dt -= step;
    age_ += step;
    const double substep = step / std::ceil(step);
    G_.setZero();
    for (double done = 0; done < step - 1e-9; done += substep) move_mean(substep);
    // Half of v and w into the cross terms, then r with the middle ones, then the other
    // half.
    const int w = 2 * n_;
    const auto half = [&] {
      for (int i = 0; i < n_; ++i) {
        auto vr = P_.col(i).segment(n_, n_);
        const double h = 0.5 * step;
        vr.tail(n_ - i).noalias() += h * P_.col(n_ + i).segment(n_ + i, n_ - i);
        vr.head(i).noalias() += h * P_.row(n_ + i).segment(n_, i).transpose();
        vr.noalias() += h * (G_(i, 0) * P_.row(w).segment(n_, n_).transpose() +
                             G_(i, 1) * P_.row(w + 1).segment(n_, n_).transpose());
        P_(w, i) += h * (P_(w, n_ + i) + G_(i, 0) * P_(w, w) + G_(i, 1) * P_(w + 1, w));
        P_(w + 1, i) += h * (P_(w + 1, n_ + i) + G_(i, 0) * P_(w + 1, w) +
                             G_(i, 1) * P_(w + 1, w + 1));
      }
    };
    half();
    for (int i = 0; i < n_; ++i) {
      auto rr = P_.col(i).segment(i, n_ - i);
      rr.noalias() += step * (P_.col(i).segment(n_ + i, n_ - i) +
                              P_.row(n_ + i).segment(i, n_ - i).transpose() +
                              G_.col(0).tail(n_ - i) * P_(w, i) +
                              G_.col(1).tail(n_ - i) * P_(w + 1, i) +
                              G_(i, 0) * P_.row(w).segment(i, n_ - i).transpose() +
                              G_(i, 1) * P_.row(w + 1).segment(i, n_ - i).transpose());
    }
    half();
    pending_ += step;
    if (pending_ >= kNoiseStep) {
      add_noise(pending_);
      advect_covariance();
      pending_ = 0;
    }
    for (Site& site : sites_) {
      site.age += step;
      site.open = site.open && site.age < kSiteLife;
    }
  }
}

// --- observations
// --------------------------------------------------------------------------

// Takes an open site out again when it is about the same number as h (with s = h'Ph,
// m = h x, P h in Ph_, all brought up to date). Returns whether it did.
bool BoundaryFilter::drop_site(Site& site, const Functional& h, double& s, double& m,
                               double least_correlation) {
  const Functional h_site = aged_radius_at(site.bearing, site.age);
  const double s_site = apply(h_site, Ph_site_);
  const double m_site = dot(h_site, x_);
  // What was known of z before the factor bounds what its removal may leave: ageing is
  // not exact in wind, and the division would magnify that.
  if (!(s_site > 0)) return false;
  const double left = std::max(1 - site.precision * s_site, s_site / site.free_variance);
  const double precision = (1 - left) / s_site;
  const double c = dot(h, Ph_site_);
  const double grow = precision / left;
  const double s_free = s + grow * c * c;
  const double s_site_free = s_site + grow * s_site * s_site;
  const double c_free = c + grow * c * s_site;
  if (c_free * c_free < least_correlation * least_correlation * s_free * s_site_free)
    return false;
  const double move = (m_site - site.shift / site.precision) * grow;
  correct(Ph_site_, move, grow);
  Ph_.noalias() += (grow * c) * Ph_site_;
  s = s_free;
  m += c * move;
  site.open = false;
  return true;
}

BoundaryFilter::Limits BoundaryFilter::limits(const PolarReading& reading,
                                              const Local& local) const {
  const double tilt = local.slope / std::max(local.radius, kLeastRadius);
  const double texture = hypothesis_.texture_rate * age_;
  Limits limits;
  limits.noise =
      (1 + tilt * tilt) * reading.position_sd * reading.position_sd + texture * texture;
  limits.low = limits.high = reading.distance;
  if (reading.crossing) {
    // The track relative to the moving boundary, as radius at this bearing now.
    const double travel =
        reading.radial - tilt * reading.tangential - local.growth * reading.period;
    const double half =
        0.5 * std::max(reading.inside ? -travel : travel,
                       0.1 * std::hypot(reading.radial, reading.tangential));
    const double middle = reading.distance + 0.5 * local.growth * reading.period;
    limits.low = middle - half;
    limits.high = middle + half;
    // The slope is not known exactly, and where on the track it was crossed is not
    // either.
    const PeriodicSpline::Tap tap = spline_.at(reading.bearing);
    double slope_variance = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        const int a = std::max(tap.index[i], tap.index[j]);
        const int b = std::min(tap.index[i], tap.index[j]);
        slope_variance += tap.slope[i] * tap.slope[j] * P_(a, b);
      }
    }
    const double along = reading.tangential / std::max(reading.distance, kLeastRadius);
    limits.noise += slope_variance * along * along / 12;
  }
  return limits;
}

double BoundaryFilter::probability(const PolarReading& reading) const {
  const Local local = at(reading.bearing);
  const Limits l = limits(reading, local);
  const double sd = std::sqrt(local.variance + l.noise);
  if (!reading.crossing) {
    return model::normal_cdf(
        (reading.inside ? local.radius - l.low : l.low - local.radius) / sd);
  }
  return model::truncate_normal(local.radius, sd, {l.low, l.high}).mass;
}

double BoundaryFilter::observe(int slot, const PolarReading& reading, double false_rate) {
  const Local local = at(reading.bearing);
  const Limits l = limits(reading, local);
  const double right = 1 - false_rate;
  const double margin = reading.inside ? local.radius - l.low : l.low - local.radius;
  if (!reading.crossing && margin > kObvious * std::sqrt(local.variance + l.noise))
    return right;

  const Functional h = radius_at(spline_.at(reading.bearing));
  double s = apply(h, Ph_), m = local.radius;
  Site& site = sites_[static_cast<std::size_t>(slot)];
  double before = 1, bound = reading.distance;
  int count = 1;
  if (site.open && reading.crossing) {
    drop_site(site, h, s, m, kSamePlace);
  } else if (site.open && site.inside == reading.inside) {
    const double sign = reading.inside ? 1 : -1;
    const double old_margin =
        sign * (dot(aged_radius_at(site.bearing, site.age), x_) - site.bound);
    const Site old = site;
    if (margin >= old_margin && old.count >= kSureCount &&
        std::abs(geo::wrap_pi(reading.bearing - old.bearing)) < 0.5 * spline_.step())
      return 1;
    if (drop_site(site, h, s, m, kSamePlace)) {
      before = old.evidence;
      count = std::min(old.count + 1, kSureCount);
      // The tighter of the two bounds is the one that counts.
      if (margin > old_margin) bound = local.radius - sign * old_margin;
    }
  }
  site.open = false;

  // Readings that agree are not all false at once.
  const double wrong = std::pow(false_rate, count);
  StepLikelihood step{bound, bound, 1 - wrong, 0, wrong};
  if (reading.inside) std::swap(step.below, step.above);
  if (reading.crossing)
    step = {l.low, l.high, right * false_rate, right * right, right * false_rate};
  const double S = s + l.noise;
  const StepMoments after = condition(m, S, step);
  const double variance_gain = (after.variance - S) / (S * S);
  correct(Ph_, (after.mean - m) / S, variance_gain);
  if (!reading.crossing) {
    const double s_after = s + s * s * variance_gain;
    const double m_after = m + s / S * (after.mean - m);
    // A false-reading mixture may leave z no better known than before: nothing to keep
    // then.
    site = {s_after < (1 - 1e-6) * s,
            reading.inside,
            count,
            reading.bearing,
            bound,
            0,
            1 / s_after - 1 / s,
            m_after / s_after - m / s,
            after.evidence,
            s};
  }
  return std::min(1.0, after.evidence / std::max(before, 1e-12));
}

void BoundaryFilter::widen(double bearing, double distance, double surprise) {
  const Local local = at(bearing);
  const double off = distance - local.radius;
  const double extra = off * off / (surprise * surprise) - local.variance;
  if (!(extra > 0)) return;
  // A bump of the radius and one of the rate, so that what is known elsewhere stays.
  Ph_.setZero();
  for (int j = 0; j < n_; ++j) {
    const double away = geo::wrap_pi(bearing - j * spline_.step()) / kBump;
    Ph_[j] = std::exp(-0.5 * away * away);
  }
  Ph_ /= dot(radius_at(spline_.at(bearing)), Ph_);
  correct_covariance(Ph_, extra);
  Ph_.segment(n_, n_) = Ph_.head(n_);
  Ph_.head(n_).setZero();
  correct_covariance(Ph_, extra / std::pow(age_ + 60, 2));
}

}  // namespace skein::monitoring
