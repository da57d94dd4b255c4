// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/control/mixer.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/layer/autopilot/control/bounded.h"

namespace skein::autopilot {
namespace {

// Below this share of the largest singular value a direction cannot be steered.
constexpr double kRankTolerance = 1e-6;

constexpr double kIdleShare = 0.1;  // of a rotor's part of the thrust

}  // namespace

Mixer::Mixer(const MultirotorAirframe& airframe, std::uint8_t standing)
    : rotors_(std::min(airframe.rotors.size(), kMaxRotors)),
      most_(airframe.thrust_max),
      exponent_(airframe.thrust_exponent) {
  // Rows: thrust, roll, pitch. Rotors that stand have columns of zeros, and so get none.
  Eigen::Matrix<double, 3, Eigen::Dynamic> effect(3, rotors_);
  Eigen::RowVectorXd yaw(rotors_);
  int turning = 0;
  for (std::size_t k = 0; k < rotors_; ++k) {
    turns_[k] = (standing >> k & 1u) == 0;
    const double on = turns_[k] ? 1 : 0;
    turning += turns_[k] ? 1 : 0;
    const RotorPlace& rotor = airframe.rotors[k];
    const auto column = static_cast<Eigen::Index>(k);
    effect.col(column) = on * Vec3(1, -rotor.position.y(), rotor.position.x());
    yaw(column) = on * rotor.spin * airframe.torque_ratio;
  }
  max_thrust_ = most_ * turning;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(kRankTolerance);
  decomposition.compute(effect);
  const Eigen::MatrixXd inverse = decomposition.pseudoInverse();
  const Eigen::RowVectorXd yaw_ratio = yaw * inverse;
  // What is left of the yaw row beside thrust, roll and pitch.
  const Eigen::VectorXd pure = (yaw - yaw * inverse * effect).transpose();
  const double effectiveness = yaw.dot(pure);
  const bool can_yaw = effectiveness > kRankTolerance * yaw.squaredNorm();
  for (std::size_t k = 0; k < rotors_; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    thrust_[k] = inverse(row, 0);
    roll_[k] = inverse(row, 1);
    pitch_[k] = inverse(row, 2);
    yaw_[k] = can_yaw ? pure(row) / effectiveness : 0;
  }
  if (rotors_ > 0) {
    yaw_of_thrust_ = yaw_ratio(0);
    yaw_of_roll_ = yaw_ratio(1);
    yaw_of_pitch_ = yaw_ratio(2);
  }
}

bool Mixer::holds_still() const {
  for (std::size_t k = 0; k < rotors_; ++k)
    if (turns_[k] && thrust_[k] < kIdleShare / static_cast<double>(rotors_)) return false;
  return true;
}

double Mixer::throttle(double thrust) const {
  const double share = bounded(thrust / most_, 0, 1);
  if (exponent_ == 2) return std::sqrt(share);
  if (exponent_ == 1) return share;
  return math::pow(share, 1 / exponent_);
}

Mix Mixer::mix(const Wrench& wrench) const {
  // Roll and pitch, as far as the rotors' range is wide enough for them at all.
  std::array<double, kMaxRotors> tilt{}, f{};
  double min = 0, largest = 0;
  for (std::size_t k = 0; k < rotors_; ++k) {
    tilt[k] = roll_[k] * wrench.torque.x() + pitch_[k] * wrench.torque.y();
    min = std::min(min, tilt[k]);
    largest = std::max(largest, tilt[k]);
  }
  const double spread = largest - min;
  const double tilt_share = spread > most_ ? most_ / spread : 1;

  // Thrust, moved to where each rotor has room for them.
  double low = 0, high = max_thrust_;
  for (std::size_t k = 0; k < rotors_; ++k) {
    tilt[k] *= tilt_share;
    if (thrust_[k] > 1e-6) {
      low = std::max(low, -tilt[k] / thrust_[k]);
      high = std::min(high, (most_ - tilt[k]) / thrust_[k]);
    }
  }
  const double thrust = low < high ? bounded(wrench.thrust, low, high) : (low + high) / 2;
  for (std::size_t k = 0; k < rotors_; ++k) f[k] = tilt[k] + thrust_[k] * thrust;

  // Yaw, as far as there is room left.
  const double yaw =
      wrench.torque.z() - yaw_of_thrust_ * thrust -
      tilt_share * (yaw_of_roll_ * wrench.torque.x() + yaw_of_pitch_ * wrench.torque.y());
  double yaw_share = 1;
  for (std::size_t k = 0; k < rotors_; ++k) {
    const double step = yaw_[k] * yaw;
    if (step > 0) yaw_share = std::min(yaw_share, std::max(0.0, most_ - f[k]) / step);
    if (step < 0) yaw_share = std::min(yaw_share, std::max(0.0, f[k]) / -step);
  }
  Mix out;
  for (std::size_t k = 0; k < rotors_; ++k)
    if (turns_[k]) out.throttle[k] = throttle(f[k] + yaw_share * yaw * yaw_[k]);
  out.tilt_limited = tilt_share < 1;
  out.yaw_limited = yaw_share < 1;
  return out;
}

}  // namespace skein::autopilot
