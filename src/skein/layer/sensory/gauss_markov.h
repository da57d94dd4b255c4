// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "skein/base/math.h"
#include "skein/base/random.h"
#include "skein/geo/vec.h"

namespace skein::sensory {

/// One step of `dt` of a first-order Gauss-Markov process of unit variance,
///
///   db/dt = -b/tau + w,   b(t + dt) = keep b(t) + stir n,  n standard normal,
///   keep = exp(-dt/tau),  stir = sqrt(1 - keep^2)
///
/// exact for any dt: the statistics do not depend on the rate of a sensor.
struct GaussMarkovStep {
  double keep = 0;
  double stir = 1;

  /// @param dt   [s]
  /// @param tau  correlation time [s]; 0 makes the process white.
  static GaussMarkovStep over(double dt, double tau) {
    if (tau <= 0) return {};
    return {math::exp(-dt / tau), std::sqrt(-math::expm1(-2 * dt / tau))};
  }

  double operator()(double b, double n) const { return keep * b + stir * n; }
};

/// Three independent standard normals.
inline Vec3 normal3(FastNormals& normal) {
  const double x = normal(), y = normal(), z = normal();
  return {x, y, z};
}

/// A first-order Gauss-Markov bias of a vector, in steps of one length; it starts in its
/// steady state.
class GaussMarkov3 {
 public:
  /// @param sd   of each component in the steady state, in the unit of the value.
  /// @param dt   time between two calls of step() [s].
  /// @param tau  correlation time [s].
  GaussMarkov3(double sd, double dt, double tau, FastNormals& normal)
      : sd_(sd), step_(GaussMarkovStep::over(dt, tau)), b_(normal3(normal)) {}

  Vec3 value() const { return sd_ * b_; }
  void step(FastNormals& normal) { b_ = step_.keep * b_ + step_.stir * normal3(normal); }

 private:
  double sd_;
  GaussMarkovStep step_;
  Vec3 b_;
};

/// The same for one number.
class GaussMarkov1 {
 public:
  GaussMarkov1(double sd, double dt, double tau, FastNormals& normal)
      : sd_(sd), step_(GaussMarkovStep::over(dt, tau)), b_(normal()) {}

  double value() const { return sd_ * b_; }
  void step(FastNormals& normal) { b_ = step_(b_, normal()); }

 private:
  double sd_;
  GaussMarkovStep step_;
  double b_;
};

}  // namespace skein::sensory
