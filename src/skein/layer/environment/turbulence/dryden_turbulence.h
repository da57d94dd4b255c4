// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/layer/environment/turbulence/dryden_spectrum.h"
#include "skein/layer/environment/turbulence/transverse_filter.h"
#include "skein/role/turbulence.h"

namespace skein::environment {

/// Continuous turbulence of the Dryden form, at the vehicle's height and airspeed V, as
/// gusts u, v, w and as rates p, q, r on an airframe of span b. With spatial frequency
/// Omega [rad/m], the spectra (one-sided: their integral from 0 is the variance) are
///
///   u  sigma_u^2 2 Lu/pi / (1 + (Lu Omega)^2)
///   v  sigma_u^2 Lu/pi (1 + 3 (Lu Omega)^2) / (1 + (Lu Omega)^2)^2;   w alike
///   p  sigma_w^2 0.8/Lw (pi Lw/(4 b))^(1/3) / (1 + (4 b Omega/pi)^2)
///   q  w Omega^2 / (1 + (4 b Omega/pi)^2)
///   r  v Omega^2 / (1 + (3 b Omega/pi)^2)
///
/// As the air is taken for frozen, everything is a function of the distance through the
/// air: steps of V dt, exact in distribution for any V and dt, from the steady state.
/// Signs are those of the air turning as a rigid body: q = -dw/dx, r = dv/dx.
///
/// Axes: up to 1,000 ft u is along the horizontal velocity through the mean air, v to its
/// right, w down; above 2,000 ft they are the body's; between, the gust goes over
/// linearly. The rates are about the body's axes everywhere.
///
/// Valid:  V is taken as at least 1 m/s. Coefficients are renewed when height or airspeed
///         has changed by 1 %.
/// Cost:   two blocks of random numbers a step; see bench/sensory_bench.cpp.
/// Reference: [MIL-F-8785C] 3.7.1.2, 3.7.2, 3.7.3.
class DrydenTurbulence final : public Turbulence {
 public:
  /// @param instance  number among the turbulences of this entity, from 0.
  DrydenTurbulence(const DrydenOptions& options, std::uint64_t seed, EntityId entity,
                   std::uint32_t instance = 0);

  Gust advance(const TurbulenceView& view, double dt) override;

 private:
  void update(double height, double distance);
  void step();

  DrydenOptions options_;
  RandomStream random_;
  bool calm_;
  bool started_ = false;
  double height_ = -1;    // that spectrum_ is for [m]
  double distance_ = -1;  // that the coefficients are for [m]
  DrydenSpectrum spectrum_;
  TransverseFilter v_, w_;
  double keep_u_ = 0, stir_u_ = 1, keep_p_ = 0, stir_p_ = 1;
  double sigma_p_ = 0;
  double u_ = 0, p_ = 0;  // in standard deviations
};

}  // namespace skein::environment
