// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/aerodynamics.h"

#include <limits>

#include "skein/base/math.h"

namespace skein::asset {

Aerodynamics::Aerodynamics(const WingGeometry& wing, const AeroCoefficients& c,
                           const std::optional<Stall>& stall)
    : c_(c),
      area_(wing.area),
      span_(wing.span),
      chord_(wing.chord),
      CLq_(c.CLq * wing.chord),
      CDq_(c.CDq * wing.chord),
      CYp_(c.CYp * wing.span),
      CYr_(c.CYr * wing.span),
      Clp_(c.Clp * wing.span),
      Clr_(c.Clr * wing.span),
      Cmq_(c.Cmq * wing.chord),
      Cnp_(c.Cnp * wing.span),
      Cnr_(c.Cnr * wing.span),
      stalls_(stall.has_value()) {
  // qS CLq q c/(2 V) = (rho V/2) S (CLq c/2) q.
  for (double* x : {&CLq_, &CDq_, &CYp_, &CYr_, &Clp_, &Clr_, &Cmq_, &Cnp_, &Cnr_})
    *x /= 2;
  if (!stalls_) {
    peak_ = {std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
    return;
  }
  stall_alpha_ = stall->alpha;
  sharpness_ = stall->sharpness;
  both_ = math::exp(-2 * sharpness_ * stall_alpha_);
  // The first peak, before the plate's own near 0.96 rad.
  constexpr double kStep = 1e-3;
  peak_ = {0, lift_coefficient(0)};
  for (double a = kStep; a <= stall_alpha_; a += kStep)
    if (const double CL = lift_coefficient(a); CL > peak_.lift_coefficient)
      peak_ = {a, CL};
}

double Aerodynamics::lift_coefficient(double alpha) const {
  const double linear = c_.CL0 + c_.CLa * alpha;
  if (!stalls_) return linear;
  const double s = stalled(std::abs(alpha)), sine = math::sin(alpha);
  return (1 - s) * linear + s * 2 * std::copysign(sine * sine, sine) * math::cos(alpha);
}

}  // namespace skein::asset
