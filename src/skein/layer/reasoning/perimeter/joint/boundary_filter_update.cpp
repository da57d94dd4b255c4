// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/boundary_filter.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/geo/vec.h"
#include "skein/layer/reasoning/perimeter/joint/outer_products.h"
#include "skein/layer/reasoning/perimeter/joint/step_likelihood.h"
#include "skein/model/probability/truncated_normal.h"

namespace skein::perimeter {
namespace {

constexpr double kSiteLife = 60;     // a bound older than this stays for good [s]
constexpr double kSamePlace = 0.9;   // correlation from which two bounds are one
constexpr int kSureCount = 4;        // so many agreeing readings are not all false
constexpr double kStepShare = 0.3;   // of the bearings that lie at steps of the boundary
constexpr double kStepNoise = 3;     // texture there, of the mean one
constexpr double kLevelNoise = 0.4;  // and elsewhere
constexpr double kSurprise = 2.5;   // sigma from which a crossing inflates the covariance
constexpr double kSoftening = 3;    // maximum it then adds, of the variance there was
constexpr double kRateShare = 0.1;  // of the age, in which a rate has gone wrong
constexpr double kBump = 0.25;      // width of what widen() opens [rad]
constexpr double kObvious = 3.2;    // readings this many sigma off teach nothing

}  // namespace

BoundaryFilter::Functional BoundaryFilter::radius_at(
    const PeriodicSpline::Tap& tap) const {
  Functional h;
  for (std::size_t i = 0; i < 4; ++i) h.add(r(tap.index[i]), tap.value[i]);
  return h;
}

// The radius `age` seconds ago, carried back at the present rates.
BoundaryFilter::Functional BoundaryFilter::aged_radius_at(double bearing,
                                                          double age) const {
  const PeriodicSpline::Tap tap = spline_.at(bearing);
  Functional h = radius_at(tap);
  double radius = 0, slope = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    h.add(v(tap.index[i]), -age * tap.value[i]);
    radius += tap.value[i] * x_[r(tap.index[i])];
    slope += tap.slope[i] * x_[r(tap.index[i])];
  }
  const Vec2 g = wind_effect(bearing, slope / std::max(radius, kMinPolarRadius));
  h.add(0, -age * g.x());
  h.add(1, -age * g.y());
  return h;
}

double BoundaryFilter::slope_variance(const PeriodicSpline::Tap& tap) const {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const int a = r(tap.index[i]), b = r(tap.index[j]);
      sum += tap.slope[i] * tap.slope[j] * P_(std::max(a, b), std::min(a, b));
    }
  }
  return sum;
}

double BoundaryFilter::dot(const Functional& h, const Eigen::VectorXd& x) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(h.size); ++i) {
    sum += h.weight[i] * x[h.index[i]];
  }
  return sum;
}

// Ph = P h; returns h' P h.
double BoundaryFilter::apply(const Functional& h, Eigen::VectorXd& Ph) const {
  Ph.setZero();
  const Eigen::Index n = P_.rows();
  for (std::size_t i = 0; i < static_cast<std::size_t>(h.size); ++i) {
    const Eigen::Index j = h.index[i];
    const Eigen::Index from = j < v(0) ? j : v(0);
    Ph.head(from).noalias() += h.weight[i] * P_.row(j).head(from).transpose();
    Ph.tail(n - from).noalias() += h.weight[i] * P_.col(j).tail(n - from);
  }
  return dot(h, Ph);
}

// Takes an open site out again when it is about the same number as h (with s = h'Ph,
// m = h x, P h in Ph_, all brought up to date), but for the covariance: Ph_site_ is to be
// added to it with the gain that is returned. Returns whether it did.
bool BoundaryFilter::drop_site(Site& site, const Functional& h, double& s, double& m,
                               double& gain) {
  const Functional h_site = aged_radius_at(site.bearing, site.age);
  const double s_site = apply(h_site, Ph_site_);
  const double m_site = dot(h_site, x_);
  // What was known of z before the factor bounds what its removal may leave: ageing is
  // not exact in wind, and the division would magnify that.
  if (!(s_site > 0)) return false;
  const double left =
      std::max(1 - site.precision * s_site, std::min(1.0, s_site / site.free_variance));
  const double precision = (1 - left) / s_site;
  const double c = dot(h, Ph_site_);
  const double grow = precision / left;
  const double s_free = s + grow * c * c;
  const double s_site_free = s_site + grow * s_site * s_site;
  const double c_free = c + grow * c * s_site;
  if (c_free * c_free < kSamePlace * kSamePlace * s_free * s_site_free) return false;
  const double move = (m_site - site.shift / site.precision) * grow;
  x_.noalias() += move * Ph_site_;
  gain = grow;
  Ph_.noalias() += (grow * c) * Ph_site_;
  s = s_free;
  m += c * move;
  site.open = false;
  return true;
}

BoundaryFilter::Limits BoundaryFilter::limits(const PolarReading& reading,
                                              const Local& local) const {
  const double tilt = local.slope / std::max(local.radius, kMinPolarRadius);
  Limits limits;
  limits.noise = (1 + tilt * tilt) * reading.position_sd * reading.position_sd;
  const double moved = local.growth * reading.age;
  limits.low = limits.high = reading.distance + moved;
  if (reading.crossing) {
    // The track relative to the moving boundary, as radius at this bearing now.
    const double travel =
        reading.radial - tilt * reading.tangential - local.growth * reading.period;
    const double half =
        0.5 * std::max(reading.inside ? -travel : travel,
                       0.1 * math::hypot(reading.radial, reading.tangential));
    const double middle = reading.distance + moved + 0.5 * local.growth * reading.period;
    limits.low = middle - half;
    limits.high = middle + half;
    // The slope is not known exactly, and where on the track it was crossed is not
    // either.
    const double along = reading.tangential / std::max(reading.distance, kMinPolarRadius);
    limits.noise += slope_variance(spline_.at(reading.bearing)) * along * along / 12;
  }
  return limits;
}

// The two grounds of the boundary's texture: level stretches, where the spline shows it
// almost exactly, and steps, where it is far off.
std::array<BoundaryFilter::Ground, 2> BoundaryFilter::grounds() const {
  const double texture = math::squared(hypothesis_.texture_rate * age_);
  return {{{1 - kStepShare, kLevelNoise * kLevelNoise * texture},
           {kStepShare, kStepNoise * kStepNoise * texture}}};
}

// Moments of the spline's radius, N(m, s), after a reading of the boundary itself, which
// has texture: a mixture over the grounds.
StepMoments BoundaryFilter::condition_on_texture(double m, double s, double noise,
                                                 const StepLikelihood& step) const {
  const auto condition_one = [&](double extra) {
    const double S = s + noise + extra;
    const StepMoments z = condition(m, S, step);
    return StepMoments{z.evidence, m + s / S * (z.mean - m),
                       s + s * s * (z.variance - S) / (S * S)};
  };
  if (!(hypothesis_.texture_rate > 0)) return condition_one(0);
  StepMoments mixed;
  double square = 0;
  for (const Ground& ground : grounds()) {
    const StepMoments one = condition_one(ground.noise);
    const double weight = ground.share * one.evidence;
    mixed.evidence += weight;
    mixed.mean += weight * (one.mean - m);
    square += weight * (one.variance + (one.mean - m) * (one.mean - m));
  }
  // An impossible reading says nothing about the ground either.
  if (!(mixed.evidence > 0)) return condition_one(grounds()[1].noise);
  const double move = mixed.mean / mixed.evidence;
  return {mixed.evidence, m + move, square / mixed.evidence - move * move};
}

double BoundaryFilter::probability(const PolarReading& reading) const {
  const Local local = at(reading.bearing);
  const Limits l = limits(reading, local);
  double sum = 0;
  for (const Ground& ground : grounds()) {
    const double sd = std::sqrt(local.spline_variance + l.noise + ground.noise);
    const double one =
        reading.crossing
            ? model::truncate_normal(local.radius, sd, {l.low, l.high}).mass
            : model::normal_cdf(
                  (reading.inside ? local.radius - l.low : l.low - local.radius) / sd);
    sum += ground.share * one;
  }
  return sum;
}

double BoundaryFilter::observe(int slot, const PolarReading& reading, double false_rate) {
  const Local local = at(reading.bearing);
  const Limits l = limits(reading, local);
  const double right = 1 - false_rate;
  const double margin = reading.inside ? local.radius - l.low : l.low - local.radius;
  if (!reading.crossing &&
      margin > kObvious * std::sqrt(local.spline_variance + l.noise + grounds()[1].noise))
    return right;

  if (reading.crossing) inflate(reading, local, l);
  settle();
  const Functional h = radius_at(spline_.at(reading.bearing));
  double s = apply(h, Ph_), m = local.radius;
  if (s < kMinVariance) {
    inflate_covariance(reading.bearing, kMinVariance - s);
    s = apply(h, Ph_);
  }
  Site& site = sites_[static_cast<std::size_t>(slot)];
  double before = 1, bound = l.low, dropped = 0;
  int count = 1;
  site.open = site.open && site.age < kSiteLife;
  if (site.open && reading.crossing) {
    drop_site(site, h, s, m, dropped);
  } else if (site.open && site.inside == reading.inside) {
    const double sign = reading.inside ? 1 : -1;
    const double old_margin =
        sign * (dot(aged_radius_at(site.bearing, site.age), x_) - site.bound);
    const Site old = site;
    if (margin >= old_margin && old.count >= kSureCount &&
        std::abs(geo::wrap_pi(reading.bearing - old.bearing)) < 0.5 * spline_.step())
      return 1;
    if (drop_site(site, h, s, m, dropped)) {
      before = old.evidence;
      count = std::min(old.count + 1, kSureCount);
      // The tighter of the two bounds is the one that counts.
      if (margin > old_margin) bound = local.radius - sign * old_margin;
    }
  }
  site.open = false;
  s = std::max(s, kMinVariance);

  // Readings that agree are not all false at once.
  const double wrong = math::pow(false_rate, count);
  StepLikelihood step{bound, bound, 1 - wrong, 0, wrong};
  if (reading.inside) std::swap(step.below, step.above);
  if (reading.crossing)
    step = {l.low, l.high, right * false_rate, right * right, right * false_rate};
  const StepMoments after = condition_on_texture(m, s, l.noise, step);
  x_.noalias() += ((after.mean - m) / s) * Ph_;
  const double gain = (after.variance - s) / (s * s);
  if (dropped != 0)
    add_outer_products(P_, v(0), {Ph_site_, dropped}, {Ph_, gain});
  else
    add_outer_product(P_, v(0), {Ph_, gain});
  changed_ = true;
  if (!reading.crossing) {
    // A false-reading mixture may leave z no better known than before: nothing to keep
    // then.
    site = {after.variance < (1 - 1e-6) * s,
            reading.inside,
            count,
            reading.bearing,
            bound,
            0,
            1 / after.variance - 1 / s,
            after.mean / after.variance - m / s,
            after.evidence,
            s};
  }
  return std::min(1.0, after.evidence / std::max(before, 1e-12));
}

// A crossing that is a surprise shows that the model is wrong near there: the rates have
// changed, or the boundary has a feature that the spline or the linearisation misses.
void BoundaryFilter::inflate(const PolarReading& reading, const Local& local,
                             const Limits& l) {
  const double off = 0.5 * (l.low + l.high) - local.radius;
  const double half = 0.5 * (l.high - l.low);
  const double expected =
      local.spline_variance + l.noise + half * half / 3 + grounds()[1].noise;
  const double surplus = off * off / (kSurprise * kSurprise) - expected;
  if (surplus > 0)
    inflate_covariance(reading.bearing, std::min(surplus, kSoftening * expected));
}

void BoundaryFilter::widen(double bearing, double distance, double surprise) {
  const Local local = at(bearing);
  const double off = distance - local.radius;
  const double extra = off * off / (surprise * surprise) - local.variance;
  if (extra > 0) inflate_covariance(bearing, extra);
}

// Adds variance to the radius near a bearing, and to the rate as if it had built up since
// the start. What is known elsewhere stays.
void BoundaryFilter::inflate_covariance(double bearing, double extra) {
  settle();
  Ph_.setZero();
  for (int j = 0; j < n_; ++j) {
    const double away = geo::wrap_pi(bearing - j * spline_.step()) / kBump;
    Ph_[r(j)] = math::exp(-0.5 * away * away);
  }
  Ph_ /= dot(radius_at(spline_.at(bearing)), Ph_);
  const auto bump = Ph_.segment(r(0), n_);
  const double rate_extra = extra / math::squared(kRateShare * age_ + 60);
  for (int j = 0; j < n_; ++j) {
    P_.col(r(j)).segment(r(j), n_ - j).noalias() += (extra * bump[j]) * bump.tail(n_ - j);
    P_.col(v(j)).tail(n_).noalias() += (rate_extra * bump[j]) * bump;
  }
  changed_ = true;
}

}  // namespace skein::perimeter
