// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/base/random.h"
#include "skein/layer/reasoning/perimeter/pointwise/point_rule.h"

namespace skein::perimeter {

/// A cloud of weighted samples for each control point: a bootstrap particle filter with
/// systematic resampling [Gordon93] and kernel smoothing that keeps mean and covariance
/// [LiuWest01], so that rates, which never change by themselves, do not run out of
/// values.
///
/// A reading weighs each particle by the probability of the reading if the particle were
/// true, (1 - e) Phi(r/s) + e (1 - Phi(r/s)), with r its range on the reading's side, s
/// the sensor's noise and e the rate of false readings. The belief thus keeps its cut
/// shape, and the same reading again cuts little more, where moment matching shrinks on.
///
/// Where fewer than `kTooFew` particles of weight would remain (a conflict far out, a
/// crossing), the cloud is drawn anew from the Gaussian update of its moments: the sample
/// then knows less than the formula.
///
/// Cost: about 25 ns per particle and reading; points without a reading cost nothing.
class ParticleRule final : public PointRule {
 public:
  /// @param count       particles per point, at least 20.
  /// @param false_rate  probability that a reading is false, in [0, 1].
  ParticleRule(int count, double false_rate, std::uint64_t seed);

  void start(std::span<const model::ControlPoint> points) override;
  void predict(std::span<model::ControlPoint> points, double dt, double noise) override;
  void half_space(std::size_t index, model::ControlPoint& point,
                  const HalfSpace& reading) override;
  void crossing(std::size_t index, model::ControlPoint& point, const Vec2& where,
                double sd) override;
  std::unique_ptr<PointRule> clone() const override {
    return std::make_unique<ParticleRule>(*this);
  }

 private:
  static constexpr double kTooFew = 10;

  struct Cloud {
    std::vector<Eigen::Vector4d> particles;
    std::vector<double> weights;  // sum 1
    RandomStream random;
    double pending = 0;  // time that the particles are behind [s]
  };
  void catch_up(Cloud& cloud) const;
  void draw(Cloud& cloud, const model::ControlPoint& point) const;
  void resample(Cloud& cloud, const model::ControlPoint& moments) const;
  // Weights times likelihood; false and nothing changed when too few particles would
  // remain.
  bool weigh(Cloud& cloud, std::span<const double> likelihood,
             model::ControlPoint& point);

  int count_;
  double false_rate_;
  std::uint64_t seed_;
  double noise_ = 0;
  std::vector<Cloud> clouds_;
  std::vector<double> likelihood_;  // scratch
};

}  // namespace skein::perimeter
