// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <functional>

#include "skein/base/random.h"
#include "skein/layer/autopilot/estimator/error_covariance.h"
#include "skein/layer/autopilot/estimator/observations.h"
#include "skein/layer/autopilot/estimator/strapdown.h"

namespace skein::autopilot::derivative_test {
namespace {

constexpr auto kN = static_cast<Eigen::Index>(error::kSize);
using Matrix = Eigen::MatrixXd;

Navigated some_state() {
  Navigated x;
  x.p_N = {100, -50, -200};
  x.v_N = {15, 8, -1};
  x.q_NB = geo::from_euler({0.4, -0.1, 0.8});
  x.gyro_bias = {0.01, -0.02, 0.005};
  x.accel_bias = {0.1, -0.2, 0.15};
  x.gyro_scale = {0.003, -0.002, 0.004};
  x.wind_N = {3, -2};
  x.magnetic_bias = {0.01, 0.02, -0.01};
  x.airspeed_scale = 0.02;
  return x;
}

ErrorVector one(std::size_t i, double size) {
  ErrorVector e{};
  e[i] = size;
  return e;
}

// True rate of turn, by the gyros' errors of `x`.
Vec3 rate(const Navigated& x) {
  return (Vec3(0.6, 0.2, -0.1) - x.gyro_bias)
      .cwiseQuotient(Vec3(Vec3::Ones() + x.gyro_scale));
}

// A tenth of a second of an aircraft that rolls and pulls, with the biases of `x`.
Navigated moved(Navigated x, Transition& f) {
  for (int k = 0; k < 10; ++k)
    strapdown(x, f, rate(x), Vec3(0.5, 0.8, -14 - 0.1 * k) - x.accel_bias, 0.01);
  return x;
}

// F, by what propagate() makes of a covariance that is e e': (F e)(F e)'.
Matrix matrix_of(const Transition& f) {
  Matrix out(kN, kN);
  const auto column = [&f](const std::vector<std::size_t>& ones) {
    ErrorCovariance p;
    for (std::size_t i : ones)
      for (std::size_t j : ones)
        if (j <= i) p.add(i, j, 1);
    p.propagate(f);
    return p;
  };
  // Column i up to its sign from (F e_i)(F e_i)'; the sign is that of its diagonal, 1.
  for (std::size_t i = 0; i < error::kSize; ++i) {
    const ErrorCovariance p = column({i});
    for (std::size_t r = 0; r < error::kSize; ++r)
      out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(i)) =
          p(r, i) / std::sqrt(p.variance(i));
  }
  return out;
}

TEST(ErrorTransition, MatchesFiniteDifferencesOfTheStrapdown) {
  const Navigated x = some_state();
  Transition f;
  const Navigated after = moved(x, f);
  f.decay.fill(1);
  const Matrix F = matrix_of(f);
  for (std::size_t i = 0; i < error::kSize; ++i) {
    const double step = 1e-5;
    Transition unused;
    const ErrorVector up = difference(moved(corrected(x, one(i, step)), unused), after);
    const ErrorVector down =
        difference(moved(corrected(x, one(i, -step)), unused), after);
    for (std::size_t r = 0; r < error::kSize; ++r) {
      const double expected = (up[r] - down[r]) / (2 * step);
      // Trapezoids leave out the third order: the turn in the step (0.06 rad) times
      // g dt^2 for position and velocity.
      EXPECT_NEAR(F(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(i)), expected,
                  4e-3)
          << r << " from " << i;
    }
  }
}

TEST(ErrorTransition, LosesLittleOverAShortStep) {
  // The same with a step of 10 ms: the error falls with the third power. Products of the
  // scale, 0.3 %, with the other errors are left out of F.
  Navigated x = some_state();
  x.gyro_scale.setZero();
  const auto moved_once = [](Navigated s, Transition& f) {
    strapdown(s, f, rate(s), Vec3(0.5, 0.8, -14) - s.accel_bias, 0.01);
    return s;
  };
  Transition f;
  const Navigated after = moved_once(x, f);
  f.decay.fill(1);
  const Matrix F = matrix_of(f);
  for (std::size_t i = 0; i < error::kSize; ++i) {
    Transition unused;
    const ErrorVector up =
        difference(moved_once(corrected(x, one(i, 1e-4)), unused), after);
    const ErrorVector down =
        difference(moved_once(corrected(x, one(i, -1e-4)), unused), after);
    for (std::size_t r = 0; r < error::kSize; ++r)
      EXPECT_NEAR(F(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(i)),
                  (up[r] - down[r]) / 2e-4, 4e-6)
          << r << " from " << i;
  }
}

// A measurement's row against what the estimate would show if the error were e.
void expect_row(const Observation& z, const std::function<double(const Navigated&)>& f,
                const Navigated& x) {
  for (std::size_t i = 0; i < error::kSize; ++i) {
    const double step = 1e-5;
    const double slope =
        (f(corrected(x, one(i, step))) - f(corrected(x, one(i, -step)))) / (2 * step);
    ErrorVector e = one(i, 1);
    EXPECT_NEAR(z.row.dot(e), slope, 1e-7) << "state " << i;
  }
}

TEST(Observations, MatchFiniteDifferences) {
  const Navigated x = some_state();
  const auto air = [](const Navigated& y) {
    return Vec3(y.v_N.x() - y.wind_N.x(), y.v_N.y() - y.wind_N.y(), y.v_N.z());
  };
  expect_row(
      observe_altitude(x), [](const Navigated& y) { return y.baro_bias - y.p_N.z(); }, x);
  expect_row(
      observe_airspeed(x),
      [&](const Navigated& y) { return (1 + y.airspeed_scale) * air(y).norm(); }, x);
  expect_row(
      observe_sideslip(x),
      [&](const Navigated& y) { return (y.q_NB.conjugate() * air(y)).y(); }, x);
  const Vec3 field(0.4, 0.05, 0.9);
  expect_row(
      observe_bearing(x, field),
      [&](const Navigated& y) {
        const Vec3 sample = y.q_NB.conjugate() * field + y.magnetic_bias;
        const Vec3 shown = x.q_NB * (sample - x.magnetic_bias);
        return std::atan2(shown.y(), shown.x());
      },
      x);
  for (int axis = 0; axis < 2; ++axis)
    expect_row(
        observe_wind(x, axis),
        [&](const Navigated& y) {
          const Vec3 sample = y.q_NB.conjugate() * air(y);
          return (x.v_N - x.q_NB * sample)[axis];
        },
        x);
}

TEST(Observations, OfThePastMatchFiniteDifferencesOfTheBackwardMotion) {
  // A true state now, flown back by what the sensors said: where was it then?
  const Navigated x = some_state();
  const double d = 0.15;
  const Vec3 f(0.3, 0.2, -11);
  const auto back = [&](const Navigated& y) {
    const Vec3 a =
        y.q_NB * Vec3(f - (y.accel_bias - x.accel_bias)) + Vec3(0, 0, kGravity);
    Past past{y.p_N - d * y.v_N + 0.5 * d * d * a, y.v_N - d * a, d, Vec3::Zero()};
    return past;
  };
  Past past = back(x);
  past.gained = d * (x.q_NB * f);
  for (int axis = 0; axis < 3; ++axis) {
    expect_row(
        observe_position(x, past, axis),
        [&](const Navigated& y) { return (back(y).p_N + y.gnss_bias)[axis]; }, x);
    expect_row(
        observe_velocity(x, past, axis),
        [&](const Navigated& y) { return back(y).v_N[axis]; }, x);
  }
}

// A full random covariance, and the same as a plain matrix.
struct Both {
  ErrorCovariance p;
  Matrix m;
};

Matrix plain(const ErrorCovariance& p) {
  Matrix m(kN, kN);
  for (std::size_t i = 0; i < error::kSize; ++i)
    for (std::size_t j = 0; j < error::kSize; ++j)
      m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = p(i, j);
  return m;
}

Both random_covariance() {
  RandomStream random(7, 0, Purpose::kTest);
  Matrix a(kN, kN);
  for (Eigen::Index i = 0; i < kN; ++i)
    for (Eigen::Index j = 0; j < kN; ++j) a(i, j) = random.normal();
  Both both;
  both.m = a * a.transpose();
  for (std::size_t i = 0; i < error::kSize; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      both.p.add(i, j,
                 both.m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  return both;
}

// Sums of some hundred products of size 100: rounding stays below this.
constexpr double kRounding = 1e-9;

TEST(ErrorCovariance, PropagatesAsTheFullMatrixDoes) {
  Both both = random_covariance();
  Transition f;
  moved(some_state(), f);
  f.decay.fill(0.9);
  for (std::size_t i = 0; i < error::kSize; ++i)
    f.noise[i] = 0.1 * static_cast<double>(i);
  Transition noiseless = f;
  noiseless.noise.fill(0);
  const Matrix F = matrix_of(noiseless);
  Matrix expected = F * both.m * F.transpose();
  for (Eigen::Index i = 0; i < kN; ++i) expected(i, i) += 0.1 * static_cast<double>(i);
  both.p.propagate(f);
  EXPECT_LT((plain(both.p) - expected).cwiseAbs().maxCoeff(), kRounding);
}

TEST(ErrorCovariance, UpdatesAsTheJosephFormDoes) {
  Both both = random_covariance();
  SparseRow h;
  h.add(error::kWind, -0.7);
  h.add(error::kAttitude + 1, 0.3);
  h.add(error::kPosition + 2, 1.1);
  Eigen::VectorXd row = Eigen::VectorXd::Zero(kN);
  for (std::size_t k = 0; k < h.size; ++k)
    row[static_cast<Eigen::Index>(h.index[k])] = h.value[k];
  const double r = 0.4;
  ErrorVector ph;
  const double s = both.p.project(h, ph) + r;
  EXPECT_NEAR(s, row.dot(both.m * row) + r, kRounding);
  both.p.reduce(ph, s);
  const Eigen::VectorXd gain = both.m * row / s;
  const Matrix left = Matrix::Identity(kN, kN) - gain * row.transpose();
  const Matrix expected = left * both.m * left.transpose() + r * gain * gain.transpose();
  EXPECT_LT((plain(both.p) - expected).cwiseAbs().maxCoeff(), kRounding);
}

TEST(ErrorCovariance, TurnsAndRestartsAsTheFullMatrixDoes) {
  Both both = random_covariance();
  const Mat3 turn = geo::exp_so3({0.1, -0.2, 0.3}).toRotationMatrix();
  Matrix G = Matrix::Identity(kN, kN);
  G.block<3, 3>(error::kMagneticBias, error::kMagneticBias) = turn;
  both.p.turn(error::kMagneticBias, turn);
  Matrix expected = G * both.m * G.transpose();
  EXPECT_LT((plain(both.p) - expected).cwiseAbs().maxCoeff(), kRounding);

  both.p.restart(error::kVelocity, 3);
  expected.row(error::kVelocity).setZero();
  expected.col(error::kVelocity).setZero();
  expected(error::kVelocity, error::kVelocity) = 3;
  EXPECT_LT((plain(both.p) - expected).cwiseAbs().maxCoeff(), kRounding);
}

}  // namespace
}  // namespace skein::autopilot::derivative_test
