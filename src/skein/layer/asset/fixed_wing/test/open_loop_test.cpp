// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/open_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/asset/fixed_wing/test/aircraft.h"
#include "skein/layer/asset/fixed_wing/trim.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset::open_loop_test {
namespace {

// The published aircraft without stall, as in the comparisons with others.
FixedWingParameters published() {
  FixedWingParameters p = aerosonde();
  p.stall.reset();
  return p;
}

// A lively flight: all inputs move, the wind turns and sinks, it banks and climbs.
struct Lively {
  FixedWingModel model{published()};
  Trim trim = find_trim(model, {25, 0, 0, 300}, TrimThrust::kDirect).trim;

  std::vector<OpenLoopInput> inputs(double duration, double spacing) const {
    std::vector<OpenLoopInput> rows;
    const int n = static_cast<int>(std::lround(duration / spacing));
    for (int i = 0; i <= n; ++i) {
      const double t = i * spacing;
      OpenLoopInput row;
      row.t = t;
      row.surfaces = {trim.surfaces.aileron + 0.004 * std::sin(1.1 * t),
                      trim.surfaces.elevator + 0.03 * std::sin(0.7 * t),
                      trim.surfaces.rudder + 0.02 * std::sin(0.9 * t + 1)};
      row.thrust = trim.thrust + 3 * std::sin(0.4 * t);
      row.wind_N = {4 - 0.05 * t, 2 + 0.03 * t, 0.5 * std::sin(0.2 * t)};
      rows.push_back(row);
    }
    return rows;
  }
  Motion start(double yaw) const {
    return trimmed_motion(trim, {0, 0, -300}, yaw, {4, 2, 0});
  }
};

double turned(const Quat& a, const Quat& b) {
  return geo::log_so3(a.conjugate() * b).norm();
}

// The same flight computed otherwise: Newton and Euler with a rotation matrix and the
// velocity through the air in body axes, angles by the library's functions, coefficients
// as the aircraft's file writes the laws, and Heun's rule with Richardson's
// extrapolation instead of Runge-Kutta.
struct Plain {
  // Air-relative velocity in B, rotation, rates, position.
  Vec3 v_AB_B, w, p_N;
  Mat3 R;
};

struct PlainRate {
  Vec3 v, w, p;
  Mat3 R;
};

PlainRate plain_rate(const FixedWingParameters& a, const Plain& s,
                     const OpenLoopInput& in, const Vec3& wind_rate_N) {
  const double u = s.v_AB_B.x(), v = s.v_AB_B.y(), w = s.v_AB_B.z();
  const double V = s.v_AB_B.norm();
  const double alpha = std::atan2(w, u), beta = std::atan2(v, std::hypot(u, w));
  const double rho = model::standard_air(-s.p_N.z()).density;
  const double q = 0.5 * rho * V * V, S = a.geometry.area;
  const AeroCoefficients& c = a.aero;
  const double P = s.w.x() * a.geometry.span / (2 * V);
  const double Q = s.w.y() * a.geometry.chord / (2 * V);
  const double Rr = s.w.z() * a.geometry.span / (2 * V);
  const double da = in.surfaces.aileron, de = in.surfaces.elevator,
               dr = in.surfaces.rudder;
  const double CL_static = c.CL0 + c.CLa * alpha;
  const double CL = CL_static + c.CLq * Q + c.CLde * de;
  const double CD = c.CD0 + c.K * CL_static * CL_static;
  const double CY = c.CYb * beta + c.CYda * da + c.CYdr * dr;
  const double Cl = c.Clb * beta + c.Clp * P + c.Clr * Rr + c.Clda * da + c.Cldr * dr;
  const double Cm = c.Cm0 + c.Cma * alpha + c.Cmq * Q + c.Cmde * de;
  const double Cn = c.Cnb * beta + c.Cnp * P + c.Cnr * Rr + c.Cnda * da + c.Cndr * dr;
  const Vec3 force(q * S * (CL * std::sin(alpha) - CD * std::cos(alpha)) + in.thrust,
                   q * S * CY, -q * S * (CL * std::cos(alpha) + CD * std::sin(alpha)));
  const Vec3 moment(q * S * a.geometry.span * Cl, q * S * a.geometry.chord * Cm,
                    q * S * a.geometry.span * Cn);
  Mat3 J = Mat3::Zero();
  J.diagonal() << a.inertia.xx, a.inertia.yy, a.inertia.zz;
  J(0, 2) = J(2, 0) = -a.inertia.xz;
  PlainRate k;
  // Body axes turn and the air itself accelerates.
  k.v = force / a.mass + s.R.transpose() * (Vec3(0, 0, kGravity) - wind_rate_N) -
        s.w.cross(s.v_AB_B);
  k.w = J.inverse() * (moment - s.w.cross(J * s.w));
  k.p = s.R * s.v_AB_B + in.wind_N;
  k.R = s.R * geo::skew(s.w);
  return k;
}

Plain plain_flight(const FixedWingParameters& a, const Motion& start,
                   const std::vector<OpenLoopInput>& rows, int steps) {
  Plain s;
  s.R = start.q_NB.toRotationMatrix();
  s.v_AB_B = s.R.transpose() * (start.v_N - rows[0].wind_N);
  s.w = start.w_NB_B;
  s.p_N = start.p_N;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double T = rows[i].t - rows[i - 1].t, h = T / steps;
    const Vec3 wind_rate = (rows[i].wind_N - rows[i - 1].wind_N) / T;
    const auto input = [&](double share) {
      OpenLoopInput in = rows[i - 1];
      const OpenLoopInput& to = rows[i];
      in.surfaces.aileron += share * (to.surfaces.aileron - in.surfaces.aileron);
      in.surfaces.elevator += share * (to.surfaces.elevator - in.surfaces.elevator);
      in.surfaces.rudder += share * (to.surfaces.rudder - in.surfaces.rudder);
      in.thrust += share * (to.thrust - in.thrust);
      in.wind_N += share * T * wind_rate;
      return in;
    };
    const auto moved = [](const Plain& from, const PlainRate& k, double dt) {
      return Plain{from.v_AB_B + dt * k.v, from.w + dt * k.w, from.p_N + dt * k.p,
                   from.R + dt * k.R};
    };
    for (int n = 0; n < steps; ++n) {
      const double share = static_cast<double>(n) / steps;
      const PlainRate a1 = plain_rate(a, s, input(share), wind_rate);
      const PlainRate a2 =
          plain_rate(a, moved(s, a1, h), input(share + 1.0 / steps), wind_rate);
      s = moved(moved(s, a1, h / 2), a2, h / 2);
      // Back to a rotation: the nearest one, by one step of Newton's iteration.
      s.R = 0.5 * (s.R + s.R.inverse().transpose().eval());
    }
  }
  return s;
}

TEST(OpenLoop, AgreesWithTheEquationsWrittenAndIntegratedOtherwise) {
  const Lively lively;
  const auto rows = lively.inputs(30, 0.1);
  const Motion start = lively.start(0.3);
  const Motion end = fly_open_loop(lively.model, start, rows).back().motion;
  const Plain coarse = plain_flight(published(), start, rows, 100);
  const Plain fine = plain_flight(published(), start, rows, 200);
  const auto better = [](const Vec3& c, const Vec3& f) -> Vec3 {
    return f + (f - c) / 3;
  };
  // Heun at 0.5 ms leaves some 1e-4 m; extrapolated, what is left is of order 3.
  EXPECT_LT((end.p_N - better(coarse.p_N, fine.p_N)).norm(), 2e-6);
  const Vec3 v_fine = fine.R * fine.v_AB_B, v_coarse = coarse.R * coarse.v_AB_B;
  EXPECT_LT((end.v_N - rows.back().wind_N - better(v_coarse, v_fine)).norm(), 1e-6);
  EXPECT_LT((end.w_NB_B - better(coarse.w, fine.w)).norm(), 1e-7);
  EXPECT_LT((rotation(end.q_NB) - (fine.R + (fine.R - coarse.R) / 3)).norm(), 1e-7);
  // It did fly about.
  EXPECT_GT(std::abs(geo::to_euler(end.q_NB).roll), 0.1);
}

TEST(OpenLoop, ErrorIsOfOrderFourWithInputsThatChangeInTime) {
  const Lively lively;
  const auto rows = lively.inputs(20, 0.4);
  const auto end = [&](double step) {
    return fly_open_loop(lively.model, lively.start(0), rows, {.longest_step = step})
        .back()
        .motion;
  };
  const Motion exact = end(0.0025);
  const auto error = [&](double step) {
    const Motion m = end(step);
    return (m.p_N - exact.p_N).norm() + (m.v_N - exact.v_N).norm() +
           turned(m.q_NB, exact.q_NB) + (m.w_NB_B - exact.w_NB_B).norm();
  };
  const double e1 = error(0.04), e2 = error(0.02), e3 = error(0.01);
  EXPECT_NEAR(std::log2(e1 / e2), 4, 0.3);
  EXPECT_NEAR(std::log2(e2 / e3), 4, 0.2);
}

TEST(OpenLoop, StepsOfTenMillisecondsAreFarBetterThanNeeded) {
  const Lively lively;
  const auto rows = lively.inputs(120, 0.1);
  const auto coarse =
      fly_open_loop(lively.model, lively.start(0), rows, {.longest_step = 0.01});
  const auto fine =
      fly_open_loop(lively.model, lively.start(0), rows, {.longest_step = 0.001});
  double p = 0, v = 0, w = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    p = std::max(p, (coarse[i].motion.p_N - fine[i].motion.p_N).norm());
    v = std::max(v, (coarse[i].motion.v_N - fine[i].motion.v_N).norm());
    w = std::max(w, (coarse[i].motion.w_NB_B - fine[i].motion.w_NB_B).norm());
  }
  // A hundredth of 5 cm, 2 mm/s, 2e-4 rad/s.
  EXPECT_LT(p, 5e-4);
  EXPECT_LT(v, 2e-5);
  EXPECT_LT(w, 2e-6);
}

TEST(OpenLoop, AnotherHeadingIsTheSameFlightTurned) {
  const Lively lively;
  const double yaw = 2.1;
  const Mat3 turn = geo::from_euler({0, 0, yaw}).toRotationMatrix();
  const auto rows = lively.inputs(60, 0.2);
  auto turned_rows = rows;
  for (OpenLoopInput& row : turned_rows) row.wind_N = turn * row.wind_N;
  const Motion start = lively.start(0.4);
  Motion turned_start = start;
  turned_start.q_NB = geo::from_euler({0, 0, yaw}) * start.q_NB;
  turned_start.v_N = turn * start.v_N;
  const auto a = fly_open_loop(lively.model, start, rows);
  const auto b = fly_open_loop(lively.model, turned_start, turned_rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // Rounding of 12,000 steps over 1.5 km.
    EXPECT_LT((turn * a[i].motion.p_N - b[i].motion.p_N).norm(), 1e-8);
    EXPECT_LT((turn * a[i].motion.v_N - b[i].motion.v_N).norm(), 1e-9);
    EXPECT_LT((a[i].motion.w_NB_B - b[i].motion.w_NB_B).norm(), 1e-10);
    EXPECT_NEAR(a[i].alpha, b[i].alpha, 1e-11);
    EXPECT_NEAR(a[i].beta, b[i].beta, 1e-11);
  }
}

TEST(OpenLoop, SteadyWindCarriesTheFlightAlong) {
  const Lively lively;
  const Vec3 wind(6, -4, 0);  // level: the density stays the same
  auto rows = lively.inputs(40, 0.5);
  for (OpenLoopInput& row : rows) row.wind_N = Vec3::Zero();
  const Motion still = trimmed_motion(lively.trim, {0, 0, -3000}, 1, Vec3::Zero());
  Motion carried = still;
  carried.v_N += wind;
  auto windy_rows = rows;
  for (OpenLoopInput& row : windy_rows) row.wind_N = wind;
  const auto a = fly_open_loop(lively.model, still, rows);
  const auto b = fly_open_loop(lively.model, carried, windy_rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vec3 expected = a[i].motion.p_N + rows[i].t * wind;
    EXPECT_LT((b[i].motion.p_N - expected).norm(), 1e-8);
    EXPECT_NEAR(a[i].airspeed, b[i].airspeed, 1e-10);
  }
}

TEST(OpenLoop, ReportsWhatAnAccelerometerFeels) {
  const Lively lively;
  const auto rows = lively.inputs(10, 0.01);
  const auto out = fly_open_loop(lively.model, lively.start(0), rows);
  for (std::size_t i = 100; i + 1 < out.size(); i += 100) {
    const Motion& m = out[i].motion;
    const Vec3 a_N = (out[i + 1].motion.v_N - out[i - 1].motion.v_N) / 0.02;
    const Vec3 f_B = rotation(m.q_NB).transpose() * (a_N - Vec3(0, 0, kGravity));
    // Central differences of 10 ms, and the inputs have kinks at the rows.
    EXPECT_LT((f_B - out[i].specific_force_B).norm(), 5e-3) << i;
    const Vec3 v_B = rotation(m.q_NB).transpose() * (m.v_N - rows[i].wind_N);
    EXPECT_NEAR(out[i].alpha, std::atan2(v_B.z(), v_B.x()), 1e-15);
    EXPECT_NEAR(out[i].beta, std::asin(v_B.y() / v_B.norm()), 1e-14);
    EXPECT_NEAR(out[i].airspeed, v_B.norm(), 1e-13);
  }
}

TEST(OpenLoop, GravityFallsOffWithHeightWhenThePlanetIsRound) {
  FixedWingParameters p = published();
  p.geometry.area = 1e-12;  // no air
  const FixedWingModel model(p);
  std::vector<OpenLoopInput> rows(2);
  rows[1].t = 1;
  Motion start;
  start.p_N = {0, 0, -1000};
  const double R = 6e6;
  const auto out = fly_open_loop(model, start, rows, {.planet_radius = R});
  // It falls 5 m in the second, which changes gravity by 5/R.
  const double g = kGravity * std::pow(R / (R + 1000), 2);
  EXPECT_NEAR(out[1].motion.v_N.z(), g, 2 * 5 / R * g);
  EXPECT_LT(g, kGravity - 3e-3);
}

TEST(OpenLoop, FallsOnAParabolaWithoutAir) {
  FixedWingParameters p = published();
  p.geometry.area = 1e-12;
  const FixedWingModel model(p);
  std::vector<OpenLoopInput> rows(2);
  rows[1].t = 20;
  Motion start;
  start.v_N = {30, -10, -90};
  start.w_NB_B = {1, -2, 0.5};
  const Motion end = fly_open_loop(model, start, rows).back().motion;
  const Vec3 expected = 20 * start.v_N + 200 * Vec3(0, 0, kGravity);
  EXPECT_LT((end.p_N - expected).norm(), 1e-6);  // what is left of the air
}

}  // namespace
}  // namespace skein::asset::open_loop_test
