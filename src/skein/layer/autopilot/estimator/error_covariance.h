// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "skein/layer/autopilot/estimator/error_state.h"

namespace skein::autopilot {

/// What the strapdown leaves for the error of an interval: A = int R_NB dt,
/// C = int R_NB diag(w) dt and s = int R_NB f dt.
struct Interval {
  double dt = 0;                             ///< [s]
  std::array<std::array<double, 3>, 3> A{};  ///< rows of A [s]
  std::array<std::array<double, 3>, 3> C{};  ///< rows of C [rad]
  std::array<double, 3> s{};                 ///< [m/s]
};

/// How the error moves while the strapdown state moves by `dt`. With the attitude error
/// in N:
///
///   theta+ = theta - A b_gyro - C k_gyro
///   v+     = v - [s]x (theta + theta+) / 2 - A b_accel
///   p+     = p + (v + v+) dt / 2
///   b+     = decay b, for each of the states that are not navigated
///
/// The middle terms are trapezoids of the exact integrals: they leave out what is of
/// third order in dt, where R f itself would have to be followed through the step.
struct Transition : Interval {
  std::array<double, error::kAttitude> decay{};  ///< of the states before the attitude
  ErrorVector noise{};                           ///< variance that comes in
};

/// One row of a measurement matrix: few entries are not zero.
struct SparseRow {
  static constexpr std::size_t kMax = 8;
  std::array<std::size_t, kMax> index{};
  std::array<double, kMax> value{};
  std::size_t size = 0;

  void add(std::size_t i, double v) {
    index[size] = i;
    value[size] = v;
    ++size;
  }
  double dot(const ErrorVector& x) const {
    double sum = 0;
    for (std::size_t k = 0; k < size; ++k) sum += value[k] * x[index[k]];
    return sum;
  }
};

/// Where row i of a lower triangle begins, when rows 2 k and 2 k + 1 are both 2 k + 2
/// long.
constexpr std::size_t row_start(std::size_t i) {
  const std::size_t k = i / 2;
  return 2 * k * (k + 1) + (i % 2) * (2 * k + 2);
}

constexpr std::size_t row_length(std::size_t i) {
  return i + 2 - i % 2;
}

/// Covariance of the error: its lower triangle by rows, so that it is symmetric by
/// construction. Rows have even length for vector instructions.
class ErrorCovariance {
 public:
  ErrorCovariance() = default;

  double operator()(std::size_t i, std::size_t j) const {
    return i >= j ? p_[row_start(i) + j] : p_[row_start(j) + i];
  }
  double variance(std::size_t i) const { return p_[row_start(i) + i]; }

  /// P+ = F P F' + Q of a step.
  void propagate(const Transition& step);

  /// @param ph  gets P h'.
  /// @returns   h P h'.
  double project(const SparseRow& h, ErrorVector& ph) const;

  /// P - (P h') (P h')' / s: what is left after a scalar measurement with innovation
  /// variance s = h P h' + r.
  void reduce(const ErrorVector& ph, double s);

  /// The three states from `at` on are components of a vector, which is turned by `R`.
  void turn(std::size_t at, const Mat3& R);

  /// State i is known anew, with this variance, from a source that says nothing about
  /// the others.
  void restart(std::size_t i, double variance);

  /// Adds variance to state i.
  void add(std::size_t i, double variance) { p_[row_start(i) + i] += variance; }

  /// Adds covariance to states i and j.
  void add(std::size_t i, std::size_t j, double covariance) {
    p_[i >= j ? row_start(i) + j : row_start(j) + i] += covariance;
  }

 private:
  alignas(16) std::array<double, row_start(error::kSize)> p_{};
};

}  // namespace skein::autopilot
