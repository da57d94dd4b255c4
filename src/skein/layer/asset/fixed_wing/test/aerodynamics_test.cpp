// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/aerodynamics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/asset/fixed_wing/test/aircraft.h"

namespace skein::asset::aerodynamics_test {
namespace {

Vec3 velocity(double V, double alpha, double beta) {
  return V * Vec3(std::cos(alpha) * std::cos(beta), std::sin(beta),
                  std::sin(alpha) * std::cos(beta));
}

TEST(FastAtan, IsAtanToRounding) {
  for (int i = -4000; i <= 4000; ++i) {
    const double t = i * 1e-4;  // on both sides of the polynomial's reach
    for (const double x : {1e-3, 1.0, 37.0}) {
      const double exact = std::atan2(t * x, x);
      EXPECT_NEAR(fast_atan2(t * x, x), exact, 3e-16 * std::abs(exact)) << t;
    }
  }
  for (const double y : {-1.0, 0.0, 1e-5, 2.0})
    for (const double x : {-1.0, 0.0, 0.5}) EXPECT_EQ(fast_atan2(y, x), std::atan2(y, x));
  EXPECT_TRUE(std::isnan(fast_atan2(std::nan(""), 1)));
}

TEST(Flow, AnglesAreThoseOfTheVelocity) {
  for (const double alpha : {-3.0, -0.4, -0.01, 0.0, 0.2, 1.0, 2.5})
    for (const double beta : {-1.5, -0.3, 0.0, 0.1, 1.2}) {
      const Flow flow(velocity(23, alpha, beta));
      EXPECT_NEAR(flow.airspeed, 23, 1e-14 * 23);
      EXPECT_NEAR(flow.alpha, alpha, 2e-14);  // conditioned by 1/cos(beta)
      EXPECT_NEAR(flow.beta, beta, 2e-14);
      EXPECT_NEAR(flow.sin_alpha, std::sin(alpha), 2e-14);
      EXPECT_NEAR(flow.cos_alpha, std::cos(alpha), 2e-14);
    }
  EXPECT_EQ(Flow(Vec3::Zero()).alpha, 0);
  EXPECT_EQ(Flow(Vec3::Zero()).beta, 0);
  EXPECT_EQ(Flow(Vec3(0, -2, 0)).beta, -geo::kPi / 2);
}

// Every coefficient stands where its law has it: one is changed, the loads change by its
// part.
TEST(Aerodynamics, EachDerivativeActsAsItsLawSays) {
  FixedWingParameters p = aerosonde();
  p.stall.reset();
  const double V = 27, rho = 1.1, alpha = 0.07, beta = -0.05;
  const Vec3 w(0.4, -0.3, 0.2);
  const Surfaces d{0.1, -0.06, 0.08};
  const Flow flow(velocity(V, alpha, beta));
  const double S = p.geometry.area, b = p.geometry.span, c = p.geometry.chord;
  const double qS = 0.5 * rho * V * V * S;
  const double P = w.x() * b / (2 * V), Q = w.y() * c / (2 * V), R = w.z() * b / (2 * V);
  const Vec3 lift_B(std::sin(alpha), 0, -std::cos(alpha));
  const Vec3 drag_B(-std::cos(alpha), 0, -std::sin(alpha));
  const double CL_static = p.aero.CL0 + p.aero.CLa * alpha;
  const auto of = [&](const AeroCoefficients& aero) {
    return Aerodynamics(p.geometry, aero, p.stall).loads(flow, w, d, rho);
  };
  const Wrench base = of(p.aero);
  const auto expect = [&](double AeroCoefficients::*member, const Vec3& force,
                          const Vec3& moment) {
    AeroCoefficients changed = p.aero;
    const double step = 0.01;
    changed.*member += step;
    const Wrench wrench = of(changed);
    // Second order where the induced drag has it.
    const double tolerance = qS * step * 3e-3;
    EXPECT_LT((wrench.force_B - base.force_B - qS * step * force).norm(), tolerance);
    EXPECT_LT((wrench.moment_B - base.moment_B - qS * step * moment).norm(),
              1e-9 + 1e-12 * tolerance);
  };
  using C = AeroCoefficients;
  const Vec3 none = Vec3::Zero(), ey = Vec3::UnitY();
  const Vec3 static_lift = lift_B + 2 * p.aero.K * CL_static * drag_B;
  expect(&C::CL0, static_lift, none);
  expect(&C::CLa, alpha * static_lift, none);
  expect(&C::CLq, Q * lift_B, none);
  expect(&C::CLde, d.elevator * lift_B, none);
  expect(&C::CD0, drag_B, none);
  expect(&C::K, CL_static * CL_static * drag_B, none);
  expect(&C::CDq, std::abs(Q) * drag_B, none);
  expect(&C::CDde, std::abs(d.elevator) * drag_B, none);
  expect(&C::Cm0, none, c * ey);
  expect(&C::Cma, none, c * alpha * ey);
  expect(&C::Cmq, none, c * Q * ey);
  expect(&C::Cmde, none, c * d.elevator * ey);
  struct Sideways {
    double C::*Y;
    double C::*l;
    double C::*n;
    double by;
  };
  for (const Sideways& s :
       {Sideways{&C::CY0, &C::Cl0, &C::Cn0, 1}, Sideways{&C::CYb, &C::Clb, &C::Cnb, beta},
        Sideways{&C::CYp, &C::Clp, &C::Cnp, P}, Sideways{&C::CYr, &C::Clr, &C::Cnr, R},
        Sideways{&C::CYda, &C::Clda, &C::Cnda, d.aileron},
        Sideways{&C::CYdr, &C::Cldr, &C::Cndr, d.rudder}}) {
    expect(s.Y, s.by * ey, none);
    expect(s.l, none, b * s.by * Vec3::UnitX());
    expect(s.n, none, b * s.by * Vec3::UnitZ());
  }
}

TEST(Aerodynamics, GustRatesActLikeTheOppositeOfTheBodysOwn) {
  const FixedWingParameters p = glider();
  const Aerodynamics aero(p.geometry, p.aero, p.stall);
  const Flow flow(velocity(15, 0.03, 0.02));
  const Wrench a = aero.loads(flow, {0.3, -0.2, 0.1}, {}, 1.2);
  const Wrench still = aero.loads(flow, Vec3::Zero(), {}, 1.2);
  const Wrench b = aero.loads(flow, {-0.3, 0.2, -0.1}, {}, 1.2);
  EXPECT_LT((a.moment_B + b.moment_B - 2 * still.moment_B).norm(), 1e-13);
  EXPECT_GT((a.moment_B - still.moment_B).norm(), 0.1);
}

TEST(Aerodynamics, StallIsSmoothAndLeadsToAFlatPlate) {
  for (const FixedWingParameters& p : {aerosonde(), glider(), light_sport()}) {
    const Aerodynamics stalled(p.geometry, p.aero, p.stall);
    const Aerodynamics linear(p.geometry, p.aero, std::nullopt);
    const auto at = [&](const Aerodynamics& aero, double alpha) {
      return aero.loads(Flow(velocity(20, alpha, 0)), Vec3::Zero(), {}, 1.2);
    };
    const double qS = 0.5 * 1.2 * 400 * p.geometry.area;
    // Nowhere a jump: the steepest coefficient falls by less than 2 M CL/4 per radian.
    const double step = 1e-4;
    for (double a = -geo::kPi + step; a < geo::kPi - step; a += step) {
      const Wrench one = at(stalled, a), two = at(stalled, a + step);
      ASSERT_LT((one.force_B - two.force_B).norm(), 100 * qS * step) << a;
      ASSERT_LT((one.moment_B - two.moment_B).norm(), 100 * qS * p.geometry.chord * step)
          << a;
    }
    // Before the stall linear, to e^(-M 0.14).
    const double before = p.stall->alpha - 0.14;
    EXPECT_LT((at(stalled, before).force_B - at(linear, before).force_B).norm(),
              2e-3 * qS);
    // Across the flow a plate of drag 2, CL = 0; the force acts against the motion.
    const Wrench across = at(stalled, geo::kPi / 2);
    EXPECT_NEAR(across.force_B.z(), -qS * (2 + p.aero.CD0), 1e-6 * qS);
    EXPECT_NEAR(across.force_B.x(), 0, 1e-6 * qS);
    EXPECT_LT(across.moment_B.y(), 0);  // it turns into the wind
    // Backwards it is braked, and lifts nothing.
    const Wrench back = at(stalled, geo::kPi);
    EXPECT_NEAR(back.force_B.x(), qS * p.aero.CD0, 1e-6 * qS);
    EXPECT_NEAR(back.force_B.z(), 0, 1e-6 * qS);
    EXPECT_NEAR(stalled.lift_coefficient(stalled.peak().alpha),
                stalled.peak().lift_coefficient, 0);
    EXPECT_LT(stalled.peak().alpha, p.stall->alpha);
  }
}

// The sigmoid as the book writes it, Eq. (4.10).
TEST(Aerodynamics, StallBlendsAsInTheBook) {
  const FixedWingParameters p = aerosonde();
  const Aerodynamics aero(p.geometry, p.aero, p.stall);
  const double M = p.stall->sharpness, a0 = p.stall->alpha;
  for (double a = -1.5; a < 1.5; a += 0.01) {
    const double e1 = std::exp(-M * (a - a0)), e2 = std::exp(M * (a + a0));
    const double s = (1 + e1 + e2) / ((1 + e1) * (1 + e2));
    const double CL =
        (1 - s) * (p.aero.CL0 + p.aero.CLa * a) +
        s * 2 * std::copysign(1.0, a) * std::pow(std::sin(a), 2) * std::cos(a);
    EXPECT_NEAR(aero.lift_coefficient(a), CL, 1e-13) << a;
  }
}

}  // namespace
}  // namespace skein::asset::aerodynamics_test
