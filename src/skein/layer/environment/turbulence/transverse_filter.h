// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace skein::environment {

/// Forming filter of a transverse gust (v or w) and of its gradient along the path, as a
/// function of the distance s flown through the air. In the distance's Laplace variable
/// p, from white noise to
///
///   gust      y = K (1 + sqrt(3) L p) / (1 + L p)^2,     of unit variance
///   gradient  g = p / (1 + R p) y,                       [1/m] per unit of the gust
///
/// With a = 1/L, c = 1/R and white noise n, the states are
///
///   dx1/ds = -a x1 + sqrt(2 a) n,  dx2/ds = a (x1 - x2),  dx3/ds = c (y - x3),
///   y = (sqrt(3) x1 + (1 - sqrt(3)) x2) / sqrt(2),        g = c (y - x3)
///
/// A step is exact for any length: x+ = A x + Q^(1/2) n with A = exp(step matrix) and
/// Q = P - A P A', P being the covariance of the steady state. As it depends on c/a only,
/// changing the length of a step leaves the statistics alone.
class TransverseFilter {
 public:
  using Normals = std::array<double, 3>;

  /// Sets up for steps of `way` [m] in a gust of length scale `length` (L) [m], smoothed
  /// by the vehicle over `reach` (R) [m].
  void discretise(double distance, double length, double reach);

  /// Draws a state of the steady state.
  void start(const Normals& n);
  /// Moves on by one step.
  void step(const Normals& n);

  double gust() const;      ///< y
  double gradient() const;  ///< g [1/m]

 private:
  using Triangle = std::array<double, 6>;  // 11, 21, 22, 31, 32, 33
  static Triangle root(const Triangle& m);
  Triangle steady() const;  // P

  double a_ = 1, c_ = 1;                // [1/m]
  std::array<double, 5> transition_{};  // A: 11 (= 22), 21, 31, 32, 33
  Triangle noise_{};                    // Q^(1/2)
  double x1_ = 0, x2_ = 0, x3_ = 0;
};

}  // namespace skein::environment
