// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/pointwise/pointwise_estimator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/check.h"
#include "skein/geo/polygon.h"

namespace skein::perimeter {
namespace {

// Major semi-axis of the 1-sigma ellipse; of a circle, the radius along `normal`.
Vec2 major_axis(const Eigen::Matrix2d& P, const Vec2& normal) {
  const double middle = (P(0, 0) + P(1, 1)) / 2;
  const Vec2 twice((P(0, 0) - P(1, 1)) / 2, P(0, 1));  // at twice the axis' bearing
  const double longest = std::sqrt(std::max(0.0, middle + twice.norm()));
  if (twice.norm() <= 1e-9 * middle) return longest * normal;
  return longest * geo::unit(geo::bearing(twice) / 2);
}

}  // namespace

PointwiseEstimator::PointwiseEstimator(const PointwiseOptions& options,
                                       const PerimeterPrior& prior,
                                       std::unique_ptr<PointRule> rule, Time start)
    : options_(options), rule_(std::move(rule)), now_(start) {
  SKEIN_CHECK(options.control_points >= 8, options.control_points);
  SKEIN_CHECK(
      options.gate_sigmas > 0 && options.process_noise >= 0 && options.sensor_sd > 0,
      options.gate_sigmas, options.process_noise, options.sensor_sd);
  SKEIN_CHECK(options.sigma_v > 0 && options.min_sd > 0, options.sigma_v, options.min_sd);
  SKEIN_CHECK(prior.radius > 0 && prior.radius_sd > 0 && prior.rate_sd >= 0, prior.radius,
              prior.radius_sd, prior.rate_sd);
  const auto count = static_cast<std::size_t>(options.control_points);
  points_.resize(count);
  ring_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 radial =
        geo::unit(2 * geo::kPi * static_cast<double>(i) / static_cast<double>(count));
    const double p = prior.radius_sd * prior.radius_sd, v = prior.rate_sd * prior.rate_sd;
    points_[i].mean << prior.origin + prior.radius * radial,
        prior.rate * radial + prior.wind;
    points_[i].covariance.diagonal() << p, p, v, v;
  }
  rule_->start(points_);
}

PointwiseEstimator::PointwiseEstimator(const PointwiseEstimator& other)
    : options_(other.options_),
      rule_(other.rule_->clone()),
      now_(other.now_),
      points_(other.points_),
      ring_(other.ring_),
      health_(other.health_) {}

std::unique_ptr<PerimeterEstimator> PointwiseEstimator::clone() const {
  return std::unique_ptr<PerimeterEstimator>(new PointwiseEstimator(*this));
}

void PointwiseEstimator::predict(Time time) {
  SKEIN_CHECK(time >= now_, time.seconds(), now_.seconds());
  if (time == now_) return;
  rule_->predict(points_, (time - now_).seconds(), options_.process_noise);
  now_ = time;
}

void PointwiseEstimator::observe(const FireReading& reading) {
  ++health_.observations;
  apply(reading, kNone);
}

void PointwiseEstimator::observe(const Crossing& crossing) {
  ++health_.observations;
  const FireReading later{crossing.time, crossing.aircraft,
                          crossing.point + 0.5 * crossing.track, crossing.point_sd,
                          crossing.entered};
  if (!options_.use_crossings) return apply(later, kNone);
  const std::size_t nearest = nearest_in_bearing(crossing.point);
  // The boundary is anywhere between the two readings: a uniform distribution.
  const double sd = std::sqrt(crossing.track.squaredNorm() / 12 +
                              crossing.point_sd * crossing.point_sd +
                              options_.sensor_sd * options_.sensor_sd);
  rule_->crossing(nearest, points_[nearest], crossing.point, sd);
  apply(later, nearest);
}

void PointwiseEstimator::apply(const FireReading& reading, std::size_t except) {
  for (std::size_t i = 0; i < points_.size(); ++i) ring_[i] = points_[i].position();
  const bool expected = geo::contains(std::span<const Vec2>(ring_), reading.point);
  HalfSpace half;
  half.aircraft = reading.point;
  half.noise =
      options_.sensor_sd * options_.sensor_sd + reading.point_sd * reading.point_sd;
  half.side = model::side_of(reading.inside, expected);
  const double gate = options_.gate_sigmas * options_.gate_sigmas;
  int used = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i == except) continue;
    half.seen = look_at(points_[i], reading.point, half.noise);
    // Also passes over a point exactly under the aircraft: it has no line of sight.
    if (half.seen.range * half.seen.range >= gate * half.seen.variance) continue;
    rule_->half_space(i, points_[i], half);
    ++used;
  }
  if (used == 0 && except == kNone && half.side == model::Side::kBelow)
    ++health_.outliers;
}

Vec2 PointwiseEstimator::centre() const {
  Vec2 sum = Vec2::Zero();
  for (const model::ControlPoint& point : points_) sum += point.position();
  return sum / static_cast<double>(points_.size());
}

std::size_t PointwiseEstimator::nearest_in_bearing(const Vec2& where) const {
  const Vec2 middle = centre();
  const Vec2 towards = where - middle;
  std::size_t best = 0;
  double best_cosine = -2;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double cosine = (points_[i].position() - middle).normalized().dot(towards);
    if (i == 0 || cosine > best_cosine) {
      best_cosine = cosine;
      best = i;
    }
  }
  return best;
}

BoundaryEstimate PointwiseEstimator::boundary() const {
  const std::size_t count = points_.size();
  const std::size_t reach =
      3;  // neighbours on each side that give the direction of the edge
  BoundaryEstimate estimate{now_, {{}}};
  std::vector<BoundaryPoint>& ring = estimate.rings.front();
  ring.reserve(count);
  const Vec2 middle = centre();
  for (std::size_t i = 0; i < count; ++i) {
    const model::ControlPoint& point = points_[i];
    const Vec2 tangent = points_[(i + reach) % count].position() -
                         points_[(i + count - reach) % count].position();
    // Points on one spot have no edge; then outward is away from the middle.
    const Vec2 n = tangent.norm() > 1e-9 ? geo::outward_normal(tangent)
                                         : (point.position() - middle).normalized();
    const Eigen::Matrix4d& P = point.covariance;
    const double sigma = std::sqrt(std::max(0.0, n.dot(P.topLeftCorner<2, 2>() * n)));
    // d(n' Ppp n)/dt = 2 n' Ppv n, because position is the integral of the rate.
    const double growth = sigma > 0 ? n.dot(P.topRightCorner<2, 2>() * n) / sigma : 0;
    ring.push_back({point.position(), n, sigma, growth, n.dot(point.velocity()),
                    major_axis(P.topLeftCorner<2, 2>(), n)});
  }
  return estimate;
}

}  // namespace skein::perimeter
