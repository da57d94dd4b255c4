// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/linear_model.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

#include "skein/layer/asset/fixed_wing/open_loop.h"
#include "skein/layer/asset/fixed_wing/test/aircraft.h"

namespace skein::asset::linear_model_test {
namespace {

using L = LinearModel;
using State = LinearModel::StateVector;
using Complex = std::complex<double>;

constexpr double kAltitude = 300;

// An aircraft in steady level flight at cruise, its linear model beside it.
struct Flight {
  explicit Flight(const FixedWingParameters& p)
      : model(p),
        trim(find_trim(model, {p.envelope.cruise, 0, 0, kAltitude}, TrimThrust::kDirect)
                 .trim),
        linear(linearise(model, trim, kAltitude)) {
    steady << trim.v_AB_B, trim.w_NB_B, trim.roll, trim.pitch, kAltitude;
  }

  // Deviations from the steady flight at times 0, T ... (n-1) T, by the full equations.
  std::vector<State> response(
      const State& deviation, double T, int n,
      const Eigen::Vector4d& input = Eigen::Vector4d::Zero()) const {
    const State x = steady + deviation;
    Motion start;
    start.p_N.z() = -x[L::kHeight];
    start.q_NB = geo::from_euler({x[L::kRoll], x[L::kPitch], 0});
    start.v_N = rotation(start.q_NB) * x.head<3>();
    start.w_NB_B = x.segment<3>(3);
    std::vector<OpenLoopInput> rows(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      OpenLoopInput& row = rows[static_cast<std::size_t>(i)];
      row.t = i * T;
      row.surfaces = {trim.surfaces.aileron + input[L::kAileron],
                      trim.surfaces.elevator + input[L::kElevator],
                      trim.surfaces.rudder + input[L::kRudder]};
      row.thrust = trim.thrust + input[L::kThrust];
    }
    std::vector<State> out;
    for (const OpenLoopOutput& o : fly_open_loop(model, start, rows)) {
      const geo::Euler e = geo::to_euler(o.motion.q_NB);
      State y;
      y << rotation(o.motion.q_NB).transpose() * o.motion.v_N, o.motion.w_NB_B, e.roll,
          e.pitch, -o.motion.p_N.z();
      out.push_back(y - steady);
    }
    return out;
  }

  // The shape of the motion whose eigenvalue is `lambda`, no angle above `size` rad and
  // no speed above `size` of the airspeed.
  State shape(Complex lambda, double size) const {
    const Eigen::ComplexEigenSolver<Eigen::Matrix<Complex, L::kStates, L::kStates>>
        solver(linear.A.cast<Complex>());
    Eigen::Index nearest = 0;
    (solver.eigenvalues().array() - lambda).abs().minCoeff(&nearest);
    // The motions along and across are apart: the whole matrix has the same eigenvalue.
    EXPECT_LT(std::abs(solver.eigenvalues()[nearest] - lambda), 1e-4 * std::abs(lambda));
    const auto shape = solver.eigenvectors().col(nearest).eval();
    const double V = trim.v_AB_B.norm();
    const double largest =
        std::max({shape.head<3>().lpNorm<Eigen::Infinity>() / V,
                  std::abs(shape[L::kRoll]), std::abs(shape[L::kPitch])});
    return shape.real() * (size / largest);
  }

  // The eigenvalue of a decaying oscillation, fitted to the full equations' response: in
  // even samples y of such a motion, y[n+2] = a y[n+1] + b y[n].
  Complex fitted_pair(Complex lambda, L::State seen) const {
    const double T = 0.2 / std::abs(lambda);
    const auto x = response(shape(lambda, 2e-3), T, 40);
    Eigen::MatrixX2d M(38, 2);
    Eigen::VectorXd y(38);
    for (int n = 0; n < 38; ++n) {
      const auto i = static_cast<std::size_t>(n);
      M.row(n) << x[i + 1][seen], x[i][seen];
      y[n] = x[i + 2][seen];
    }
    const Eigen::Vector2d ab = M.colPivHouseholderQr().solve(y);
    const Complex root = std::sqrt(Complex(ab[0] * ab[0] + 4 * ab[1]));
    return std::log((ab[0] + root) / 2.0) / T;
  }

  // The same for a motion that only grows or decays: y[n+1] = a y[n].
  double fitted_real(double lambda, L::State seen) const {
    const double T = 0.1 / std::abs(lambda);
    const auto x = response(shape(lambda, 2e-3), T, 15);
    double above = 0, below = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      above += x[i + 1][seen] * x[i][seen];
      below += x[i][seen] * x[i][seen];
    }
    return std::log(above / below) / T;
  }

  FixedWingModel model;
  Trim trim;
  LinearModel linear;
  State steady;
};

// Deviations are 0.2 % of the airspeed or of a radian; what is not linear is of that
// order, the fit adds little.
constexpr double kTolerance = 0.005;

void expect_modes_as_flown(const FixedWingParameters& parameters) {
  const Flight flight(parameters);
  const Modes m = modes(flight.linear);
  const auto expect_pair = [&](const char* name, Complex lambda, L::State seen) {
    ASSERT_GT(lambda.imag(), 0) << name;
    const Complex fitted = flight.fitted_pair(lambda, seen);
    EXPECT_NEAR(natural_frequency(fitted) / natural_frequency(lambda), 1, kTolerance)
        << name;
    EXPECT_NEAR(damping_ratio(fitted), damping_ratio(lambda), kTolerance) << name;
  };
  expect_pair("short period", m.short_period[0], L::kQ);
  expect_pair("phugoid", m.phugoid[0], L::kU);
  expect_pair("dutch roll", m.dutch_roll[0], L::kR);
  ASSERT_FALSE(m.roll_spiral);
  EXPECT_NEAR(flight.fitted_real(m.roll, L::kP) / m.roll, 1, kTolerance);
  EXPECT_NEAR(flight.fitted_real(m.spiral, L::kRoll) / m.spiral, 1, kTolerance);
}

TEST(LinearModel, ModesOfTheAerosondeAreThoseFlown) {
  expect_modes_as_flown(aerosonde());
}
TEST(LinearModel, ModesOfTheGliderAreThoseFlown) {
  expect_modes_as_flown(glider());
}
TEST(LinearModel, ModesOfTheLightAircraftAreThoseFlown) {
  expect_modes_as_flown(light_sport());
}

TEST(LinearModel, ModesAreNearTheTextbooksEstimates) {
  const Flight flight(aerosonde());
  const Modes m = modes(flight.linear);
  const FixedWingParameters p = aerosonde();
  const double V = 25, rho = 1.19, S = p.geometry.area, b = p.geometry.span,
               c = p.geometry.chord;
  // Lanchester: sqrt(2) g/V, damping (D/L)/sqrt(2); the stability of the real aircraft
  // and the density take off some tenths.
  EXPECT_NEAR(natural_frequency(m.phugoid[0]) / (std::sqrt(2) * kGravity / V), 1, 0.15);
  EXPECT_NEAR(damping_ratio(m.phugoid[0]), 0.097 / std::sqrt(2), 0.02);
  // Roll subsidence: Lp alone.
  EXPECT_NEAR(m.roll / (rho * V * S * b * b * p.aero.Clp / (4 * p.inertia.xx)), 1, 0.1);
  // Short period: stiffness -(Ma + Mq Za/V).
  const double Ma = 0.5 * rho * V * V * S * c * p.aero.Cma / p.inertia.yy;
  const double Mq = rho * V * S * c * c * p.aero.Cmq / (4 * p.inertia.yy);
  const double Za_V = -0.5 * rho * V * S * (p.aero.CLa + 0.05) / p.mass;
  EXPECT_NEAR(natural_frequency(m.short_period[0]) / std::sqrt(-Ma + Mq * Za_V), 1, 0.03);
}

TEST(LinearModel, AnswersToInputsAreThoseFlown) {
  const Flight flight(aerosonde());
  const double duration = 0.5;
  for (int k = 0; k < L::kInputs; ++k) {
    Eigen::Vector4d input = Eigen::Vector4d::Zero();
    input[k] = k == L::kThrust ? 0.1 : 1e-3;
    const State flown = flight.response(State::Zero(), duration, 2, input).back();
    // x = integral of exp(A t) B u, by its series: (T + A T^2/2 + A^2 T^3/6 ...) B u.
    State x = State::Zero(), term = duration * flight.linear.B * input;
    for (int n = 2; n < 60; ++n) {
      x += term;
      term = flight.linear.A * term * duration / n;
    }
    for (const auto part : {0, 3, 6})
      EXPECT_LT((flown - x).segment<3>(part).norm(),
                0.02 * x.segment<3>(part).norm() + 1e-9)
          << k << " " << part;
  }
}

}  // namespace
}  // namespace skein::asset::linear_model_test
