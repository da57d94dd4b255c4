// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/multirotor/rotor_set.h"

#include <Eigen/LU>

#include "skein/base/check.h"

namespace skein::asset {

RotorSet::RotorSet(std::span<const RotorPlace> places) : size_(places.size()) {
  SKEIN_CHECK(size_ <= Actuators::kMaxChannels, size_);
  for (std::size_t i = 0; i < size_; ++i) {
    x_[i] = places[i].position.x();
    y_[i] = places[i].position.y();
    spin_[i] = places[i].spin;
  }
}

// With A the rows 1, -y, x, spin: total, M_x, M_y, M_z / torque_ratio = A thrusts, so
// thrusts = A' (A A')^-1 of them.
std::array<double, Actuators::kMaxChannels> RotorSet::thrusts(double total,
                                                              const Vec3& moment,
                                                              double torque_ratio) const {
  Eigen::Matrix<double, 4, Actuators::kMaxChannels> A =
      Eigen::Matrix<double, 4, Actuators::kMaxChannels>::Zero();
  for (std::size_t i = 0; i < size_; ++i)
    A.col(static_cast<Eigen::Index>(i)) << 1, -y_[i], x_[i], spin_[i];
  const Eigen::Vector4d setpoint(total, moment.x(), moment.y(),
                                 moment.z() / torque_ratio);
  const Eigen::Matrix4d square = A * A.transpose();
  const Eigen::Matrix<double, Actuators::kMaxChannels, 1> min =
      A.transpose() * square.fullPivLu().solve(setpoint);
  std::array<double, Actuators::kMaxChannels> thrusts{};
  for (std::size_t i = 0; i < size_; ++i) thrusts[i] = min[static_cast<Eigen::Index>(i)];
  return thrusts;
}

bool RotorSet::controllable() const {
  Eigen::Matrix<double, 4, Actuators::kMaxChannels> A =
      Eigen::Matrix<double, 4, Actuators::kMaxChannels>::Zero();
  for (std::size_t i = 0; i < size_; ++i)
    A.col(static_cast<Eigen::Index>(i)) << 1, -y_[i], x_[i], spin_[i];
  for (int row = 0; row < 4; ++row) {  // so that metres do not count against ones
    if (A.row(row).norm() == 0) return false;
    A.row(row).normalize();
  }
  Eigen::FullPivLU<Eigen::Matrix4d> lu(A * A.transpose());
  lu.setThreshold(1e-6);
  return lu.isInvertible();
}

}  // namespace skein::asset
