// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/parameter_spread.h"

namespace skein::assemble {
namespace {

// Draws one factor for each call, so that the order of calls is part of the result.
class Factors {
 public:
  Factors(double share, RandomStream& random) : share_(share), random_(random) {}
  double next() { return random_.uniform(1 - share_, 1 + share_); }
  template <class... Values>
  void each(Values&... values) {
    ((values *= next()), ...);
  }

 private:
  double share_;
  RandomStream& random_;
};

// One factor for all, so that the inertia stays that of some body.
void scale(asset::Inertia& inertia, double factor) {
  for (double* j :
       {&inertia.xx, &inertia.yy, &inertia.zz, &inertia.xy, &inertia.xz, &inertia.yz})
    *j *= factor;
}

}  // namespace

void spread(asset::FixedWingParameters& p, double share, RandomStream random) {
  Factors by(share, random);
  by.each(p.mass);
  scale(p.inertia, by.next());
  asset::AeroCoefficients& a = p.aero;
  by.each(a.CL0, a.CLa, a.CLq, a.CLde, a.CD0, a.K, a.CDq, a.CDde);
  by.each(a.Cm0, a.Cma, a.Cmq, a.Cmde);
  by.each(a.CY0, a.CYb, a.CYp, a.CYr, a.CYda, a.CYdr);
  by.each(a.Cl0, a.Clb, a.Clp, a.Clr, a.Clda, a.Cldr);
  by.each(a.Cn0, a.Cnb, a.Cnp, a.Cnr, a.Cnda, a.Cndr);
  if (auto* motor = std::get_if<asset::ElectricMotor>(&p.propulsion)) {
    const double thrust = by.next(), torque = by.next();
    for (double* c : {&motor->CT0, &motor->CT1, &motor->CT2}) *c *= thrust;
    for (double* c : {&motor->CQ0, &motor->CQ1, &motor->CQ2}) *c *= torque;
  }
  if (auto* engine = std::get_if<asset::PistonEngine>(&p.propulsion))
    by.each(engine->power_max, engine->static_thrust);
  if (p.hand_launch) by.each(p.hand_launch->speed, p.hand_launch->pitch);
}

void spread(asset::MultirotorParameters& p, double share, RandomStream random) {
  Factors by(share, random);
  by.each(p.mass);
  scale(p.inertia, by.next());
  by.each(p.thrust_factor, p.torque_factor, p.rotor_drag, p.axial_drag, p.turn_drag,
          p.motor_lag);
  by.each(p.drag_area.x(), p.drag_area.y(), p.drag_area.z());
}

void spread(asset::PerformanceParameters& p, double share, RandomStream random) {
  Factors by(share, random);
  by.each(p.mass, p.zero_lift_drag, p.induced_drag, p.power);
}

}  // namespace skein::assemble
