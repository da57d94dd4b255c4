// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/layer/asset/fixed_wing/fast_atan.h"
#include "skein/layer/asset/fixed_wing/parameters.h"

namespace skein::asset {

/// Deflections of the control surfaces [rad], signs as in data/vehicle/control.h.
struct Surfaces {
  double aileron = 0, elevator = 0, rudder = 0;
};

/// How the air meets the aircraft.
struct Flow {
  double airspeed = 0;                  ///< V [m/s]
  double alpha = 0;                     ///< angle of attack, atan2(w, u) [rad]
  double beta = 0;                      ///< side-slip, atan2(v, sqrt(u^2 + w^2)) [rad]
  double sin_alpha = 0, cos_alpha = 1;  ///< of alpha

  /// @param v_AB_B  (u, v, w): velocity of the aircraft through the air [m/s]. At rest
  ///                both angles are 0.
  [[gnu::always_inline]] explicit Flow(const Vec3& v_AB_B) {
    const double u = v_AB_B.x(), v = v_AB_B.y(), w = v_AB_B.z();
    const double in_plane2 = u * u + w * w;
    airspeed = std::sqrt(in_plane2 + v * v);
    if (in_plane2 > 0) [[likely]] {
      const double in_plane = std::sqrt(in_plane2), inverse = 1 / in_plane;
      sin_alpha = w * inverse;
      cos_alpha = u * inverse;
      alpha = fast_atan2(w, u);
      beta = fast_atan2(v, in_plane);
    } else if (v != 0) {
      beta = std::copysign(geo::kPi / 2, v);
    }
  }
};

/// Force and moment about the centre of gravity.
struct Wrench {
  Vec3 force_B = Vec3::Zero();   ///< [N]
  Vec3 moment_B = Vec3::Zero();  ///< [N m]
};

/// Aerodynamic force and moment of a fixed wing.
///
///   X = qS (CL sin a - CD cos a),  Y = qS CY,  Z = -qS (CL cos a + CD sin a)
///   L = qS b Cl,  M = qS c Cm,  N = qS b Cn,  q = rho V^2 / 2
///
/// with the coefficients of AeroCoefficients, stalled as in Stall. Nothing is divided by
/// the airspeed, so all goes to 0 with it.
/// Reference: [Beard12] section 4.2.
class Aerodynamics {
 public:
  Aerodynamics(const WingGeometry& wing, const AeroCoefficients& c,
               const std::optional<Stall>& stall);

  /// @param w_AB_B   rate of turn relative to the air [rad/s].
  /// @param density  [kg/m^3].
  [[gnu::always_inline]] Wrench loads(const Flow& flow, const Vec3& w_AB_B,
                                      const Surfaces& d, double density) const {
    const double half_rho_V = 0.5 * density * flow.airspeed;
    const double qS = half_rho_V * flow.airspeed * area_;
    const double p = w_AB_B.x(), q = w_AB_B.y(), r = w_AB_B.z();
    // Coefficients of rates times their own divisors, so that they take rho V/2.
    const double rate = half_rho_V * area_;

    const double a = flow.alpha, b = flow.beta;
    double CL = c_.CL0 + c_.CLa * a;
    double CD = c_.CD0 + c_.K * CL * CL;
    double Cm = c_.Cma * a;
    if (stalls_) {
      const double s = stalled(std::abs(a));
      if (s > 0) {
        const double sin2 = flow.sin_alpha * flow.sin_alpha;
        CL += s * (2 * std::copysign(sin2, flow.sin_alpha) * flow.cos_alpha - CL);
        CD += s * (c_.CD0 + 2 * sin2 * std::abs(flow.sin_alpha) - CD);
        Cm += s * (c_.Cma * flow.sin_alpha - Cm);
      }
    }
    const double lift = qS * (CL + c_.CLde * d.elevator) + rate * CLq_ * q;
    const double drag =
        qS * (CD + c_.CDde * std::abs(d.elevator)) + rate * CDq_ * std::abs(q);

    Wrench out;
    out.force_B = {lift * flow.sin_alpha - drag * flow.cos_alpha,
                   qS * (c_.CY0 + c_.CYb * b + c_.CYda * d.aileron + c_.CYdr * d.rudder) +
                       rate * (CYp_ * p + CYr_ * r),
                   -lift * flow.cos_alpha - drag * flow.sin_alpha};
    const double qSb = qS * span_, rate_b = rate * span_;
    out.moment_B = {
        qSb * (c_.Cl0 + c_.Clb * b + c_.Clda * d.aileron + c_.Cldr * d.rudder) +
            rate_b * (Clp_ * p + Clr_ * r),
        (qS * (c_.Cm0 + Cm + c_.Cmde * d.elevator) + rate * Cmq_ * q) * chord_,
        qSb * (c_.Cn0 + c_.Cnb * b + c_.Cnda * d.aileron + c_.Cndr * d.rudder) +
            rate_b * (Cnp_ * p + Cnr_ * r)};
    return out;
  }

  /// Static lift coefficient, stall included, without rates and elevator.
  double lift_coefficient(double alpha) const;

  /// The largest static lift coefficient [-], at the angle of attack `alpha` [rad];
  /// infinite at infinity when the wing does not stall.
  struct Peak {
    double alpha, lift_coefficient;
  };
  Peak peak() const { return peak_; }

 private:
  // How far the wing is stalled at |alpha| = a: 0 to 1.
  double stalled(double a) const {
    const double before = sharpness_ * (stall_alpha_ - a);
    if (before > 36) return 0;  // less than rounding
    const double x = math::exp(-before);
    return 1 - 1 / ((1 + x) * (1 + both_ / x));
  }

  AeroCoefficients c_;
  double area_, span_, chord_;
  // Derivatives by rates with b/2 or c/2.
  double CLq_, CDq_, CYp_, CYr_, Clp_, Clr_, Cmq_, Cnp_, Cnr_;
  bool stalls_;
  double stall_alpha_ = 0, sharpness_ = 0;
  double both_ = 0;  // exp(-2 M alpha_stall)
  Peak peak_{};
};

}  // namespace skein::asset
