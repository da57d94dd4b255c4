// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <optional>

#include "skein/base/math.h"
#include "skein/layer/asset/fixed_wing/trim.h"

namespace skein::asset {

/// Small deviations from a steady flight, thrust being given directly: x' = A x + B u.
///
/// x: velocity through the air in B (u, v, w) [m/s], rates (p, q, r) [rad/s], roll and
/// pitch [rad], height [m]; u: aileron, elevator, rudder [rad], thrust [N].
struct LinearModel {
  static constexpr int kStates = 9, kInputs = 4;
  enum State { kU, kV, kW, kP, kQ, kR, kRoll, kPitch, kHeight };
  enum Input { kAileron, kElevator, kRudder, kThrust };
  using StateVector = Eigen::Matrix<double, kStates, 1>;

  Eigen::Matrix<double, kStates, kStates> A;
  Eigen::Matrix<double, kStates, kInputs> B;
};

/// Derivatives at `trim` by central differences, good to about 1e-8 of the largest.
/// @param altitude_msl  at which it was trimmed [m].
LinearModel linearise(const FixedWingModel& model, const Trim& trim, double altitude_msl);

/// Eigenvalues of the motions that an aircraft shows in straight flight [1/s]. Real part:
/// growth; imaginary part: frequency. Of a pair the one with the imaginary part above 0,
/// or for two real ones the faster, comes first.
struct Modes {
  using Pair = std::array<std::complex<double>, 2>;
  // Of u, w, q, pitch and height, from the fastest to the slowest.
  Pair short_period, phugoid;
  double height = 0;  ///< the slow drift that the density's change with height makes
  // Of v, p, r and roll. When roll and spiral are no two real ones they make a pair.
  Pair dutch_roll;
  double roll = 0, spiral = 0;
  std::optional<Pair> roll_spiral;
};

/// Modes of straight flight without side-slip, where the motions in the plane of symmetry
/// are apart from the others.
Modes modes(const LinearModel& linear);

/// Angular frequency of the undamped motion [rad/s].
inline double natural_frequency(std::complex<double> eigenvalue) {
  return math::hypot(eigenvalue.real(), eigenvalue.imag());
}
/// Share of the critical damping; 1 or more: no oscillation.
inline double damping_ratio(std::complex<double> eigenvalue) {
  return -eigenvalue.real() / natural_frequency(eigenvalue);
}

}  // namespace skein::asset
