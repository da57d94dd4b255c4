// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace skein::perimeter {

/// Uniform cubic B-spline on the circle: a smooth function of bearing from `knots`
/// coefficients, of which four matter at any bearing.
///
/// Harmonics far below knots / 2 come out exact to (k 2 pi / knots)^4 / 384: 0.13 % of
/// the 8th harmonic with 60 knots.
class PeriodicSpline {
 public:
  /// How the function and its slope at one bearing follow from the coefficients.
  struct Tap {
    std::array<int, 4> index{};
    std::array<double, 4> value{};  ///< f = sum value[i] c[index[i]]
    std::array<double, 4> slope{};  ///< df/dbearing = sum slope[i] c[index[i]] [1/rad]
  };

  /// @param knots  number of coefficients, at least 8; number j belongs to bearing 2 pi j
  /// / knots.
  explicit PeriodicSpline(int knots);

  int knots() const { return knots_; }
  /// Bearing between two knots [rad].
  double step() const { return step_; }
  Tap at(double bearing) const;

  /// Factor from a harmonic's amplitude in the coefficients to its amplitude at the
  /// knots: (2 + cos(k step)) / 3.
  double response(int harmonic) const;

 private:
  int knots_;
  double step_;
};

}  // namespace skein::perimeter
