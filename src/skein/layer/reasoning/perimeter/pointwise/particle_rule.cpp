// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/pointwise/particle_rule.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/model/probability/normal.h"
#include "skein/model/probability/truncated_normal.h"

namespace skein::perimeter {

namespace {

// A lower triangular L with L L' = P for a positive semidefinite P; directions without
// variance get zero columns.
Eigen::Matrix4d square_root(const Eigen::Matrix4d& P) {
  Eigen::Matrix4d L = Eigen::Matrix4d::Zero();
  for (int j = 0; j < 4; ++j) {
    const double rest = P(j, j) - L.row(j).head(j).squaredNorm();
    if (rest <= 1e-14 * P(j, j)) continue;
    L(j, j) = std::sqrt(rest);
    for (int i = j + 1; i < 4; ++i)
      L(i, j) = (P(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
  }
  return L;
}

Eigen::Vector4d normal_vector(RandomStream& random) {
  Eigen::Vector4d g;
  for (int i = 0; i < 4; ++i) g(i) = random.normal();
  return g;
}

}  // namespace

ParticleRule::ParticleRule(int count, double false_rate, std::uint64_t seed)
    : count_(count), false_rate_(false_rate), seed_(seed) {
  SKEIN_CHECK(count >= 20 && false_rate >= 0 && false_rate <= 1, count, false_rate);
}

void ParticleRule::start(std::span<const model::ControlPoint> points) {
  clouds_.clear();
  likelihood_.resize(static_cast<std::size_t>(count_));
  for (const model::ControlPoint& point : points) {
    const auto index = static_cast<std::uint32_t>(clouds_.size());
    clouds_.push_back({{}, {}, RandomStream(seed_, index, Purpose::kParticles), 0});
    clouds_.back().particles.resize(static_cast<std::size_t>(count_));
    clouds_.back().weights.resize(static_cast<std::size_t>(count_));
    draw(clouds_.back(), point);
  }
}

void ParticleRule::predict(std::span<model::ControlPoint> points, double dt,
                           double noise) {
  // The motion is linear: the moments can go ahead, and the particles follow when needed.
  PointRule::predict(points, dt, noise);
  noise_ = noise;
  for (Cloud& cloud : clouds_) cloud.pending += dt;
}

void ParticleRule::catch_up(Cloud& cloud) const {
  const double dt = cloud.pending;
  if (dt == 0) return;
  cloud.pending = 0;
  // Square root of the covariance of integrated white acceleration.
  const double p_1 = dt * std::sqrt(noise_ * dt / 3),
               v_1 = std::sqrt(3 * noise_ * dt) / 2;
  const double v_2 = std::sqrt(noise_ * dt) / 2;
  for (Eigen::Vector4d& x : cloud.particles) {
    x.head<2>() += dt * x.tail<2>();
    if (noise_ == 0) continue;
    const Eigen::Vector4d g = normal_vector(cloud.random);
    x.head<2>() += p_1 * g.head<2>();
    x.tail<2>() += v_1 * g.head<2>() + v_2 * g.tail<2>();
  }
}

void ParticleRule::draw(Cloud& cloud, const model::ControlPoint& point) const {
  const Eigen::Matrix4d L = square_root(point.covariance);
  for (Eigen::Vector4d& x : cloud.particles)
    x = point.mean + L * normal_vector(cloud.random);
  std::fill(cloud.weights.begin(), cloud.weights.end(), 1.0 / count_);
}

void ParticleRule::resample(Cloud& cloud, const model::ControlPoint& moments) const {
  // Systematic: one random offset, equal steps through the summed weights.
  std::vector<Eigen::Vector4d> chosen;
  chosen.reserve(cloud.particles.size());
  const double offset = cloud.random.uniform();
  std::size_t i = 0;
  double summed = cloud.weights[0];
  for (int k = 0; k < count_; ++k) {
    const double target = (k + offset) / count_;
    while (summed < target && i + 1 < cloud.particles.size())
      summed += cloud.weights[++i];
    chosen.push_back(cloud.particles[i]);
  }
  // Optimal kernel width for a Gaussian in four dimensions; the shrinking towards the
  // mean takes back the variance that the kernel adds.
  const double width = math::pow(4.0 / (6.0 * count_), 1.0 / 8);
  const double keep = std::sqrt(1 - width * width);
  const Eigen::Matrix4d L = width * square_root(moments.covariance);
  for (std::size_t k = 0; k < chosen.size(); ++k)
    cloud.particles[k] = moments.mean + keep * (chosen[k] - moments.mean) +
                         L * normal_vector(cloud.random);
  std::fill(cloud.weights.begin(), cloud.weights.end(), 1.0 / count_);
}

bool ParticleRule::weigh(Cloud& cloud, std::span<const double> likelihood,
                         model::ControlPoint& point) {
  double sum = 0, squares = 0;
  for (std::size_t k = 0; k < cloud.weights.size(); ++k) {
    const double weight = cloud.weights[k] * likelihood[k];
    sum += weight;
    squares += weight * weight;
  }
  if (!(sum * sum >= kTooFew * squares) || !(sum > 1e-100)) return false;
  for (std::size_t k = 0; k < cloud.weights.size(); ++k)
    cloud.weights[k] *= likelihood[k] / sum;

  point.mean.setZero();
  for (std::size_t k = 0; k < cloud.weights.size(); ++k)
    point.mean += cloud.weights[k] * cloud.particles[k];
  point.covariance.setZero();
  for (std::size_t k = 0; k < cloud.weights.size(); ++k) {
    const Eigen::Vector4d off = cloud.particles[k] - point.mean;
    point.covariance.noalias() += (cloud.weights[k] * off) * off.transpose();
  }
  if (sum * sum < 0.5 * count_ * squares) resample(cloud, point);
  return true;
}

void ParticleRule::half_space(std::size_t index, model::ControlPoint& point,
                              const HalfSpace& reading) {
  Cloud& cloud = clouds_[index];
  catch_up(cloud);
  const double sign = reading.side == model::Side::kAbove ? 1 : -1;
  const Vec2 a = sign / std::sqrt(reading.noise) * reading.seen.direction;
  for (std::size_t k = 0; k < cloud.particles.size(); ++k) {
    const double right =
        model::normal_cdf(a.dot(cloud.particles[k].head<2>() - reading.aircraft));
    likelihood_[k] = false_rate_ + (1 - 2 * false_rate_) * right;
  }
  if (weigh(cloud, likelihood_, point)) return;
  const double above = sign > 0 ? 1 - false_rate_ : false_rate_;
  const model::MixtureMoments range = model::uncertain_half_line(
      reading.seen.range, std::sqrt(reading.seen.variance), 0, above, 1 - above);
  correct_point(point, reading.seen, {range.mean, range.variance});
  draw(cloud, point);
}

void ParticleRule::crossing(std::size_t index, model::ControlPoint& point,
                            const Vec2& where, double sd) {
  Cloud& cloud = clouds_[index];
  catch_up(cloud);
  for (std::size_t k = 0; k < cloud.particles.size(); ++k) {
    const double off = (cloud.particles[k].head<2>() - where).squaredNorm() / (sd * sd);
    likelihood_[k] = math::exp(-0.5 * off);
  }
  if (weigh(cloud, likelihood_, point)) return;
  locate_point(point, where, sd);
  draw(cloud, point);
}

}  // namespace skein::perimeter
