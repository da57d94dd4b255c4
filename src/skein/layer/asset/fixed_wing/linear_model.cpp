// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/linear_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "skein/base/math.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset {
namespace {

using StateVector = LinearModel::StateVector;
using InputVector = Eigen::Matrix<double, LinearModel::kInputs, 1>;

StateVector rate(const FixedWingModel& model, const StateVector& x,
                 const InputVector& in) {
  const Vec3 v_B = x.head<3>(), w_B = x.segment<3>(3);
  const double roll = x[LinearModel::kRoll], pitch = x[LinearModel::kPitch];
  const double density = model::standard_air(x[LinearModel::kHeight]).density;
  const Wrench wrench = model.loads(
      Flow(v_B), w_B,
      {in[LinearModel::kAileron], in[LinearModel::kElevator], in[LinearModel::kRudder]},
      density, {in[LinearModel::kThrust], 0});
  const Vec3 down_B(-math::sin(pitch), math::sin(roll) * math::cos(pitch),
                    math::cos(roll) * math::cos(pitch));
  StateVector k;
  k.head<3>() =
      model.body.inverse_mass() * wrench.force_B + kGravity * down_B - w_B.cross(v_B);
  k.segment<3>(3) = model.body.angular_acceleration(w_B, wrench.moment_B);
  const double about = math::sin(roll) * w_B.y() + math::cos(roll) * w_B.z();
  k[LinearModel::kRoll] = w_B.x() + math::tan(pitch) * about;
  k[LinearModel::kPitch] = math::cos(roll) * w_B.y() - math::sin(roll) * w_B.z();
  k[LinearModel::kHeight] = -down_B.dot(v_B);
  return k;
}

// Rows and columns of `from` listed in `which`.
Eigen::MatrixXd picked(const LinearModel& from, std::initializer_list<int> which) {
  const std::vector<int> at = which;
  return from.A(at, at);
}

// Eigenvalues, fastest first; of conjugates the one above the real axis first. One size
// for all matrices: the compiler takes ten seconds for each.
std::vector<std::complex<double>> eigenvalues(const Eigen::MatrixXd& matrix) {
  const auto values = Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    // Conjugates have the same real part to the last bit, their moduli too.
    return std::norm(a) != std::norm(b) ? std::norm(a) > std::norm(b)
                                        : a.imag() > b.imag();
  });
  return sorted;
}

}  // namespace

LinearModel linearise(const FixedWingModel& model, const Trim& trim,
                      double altitude_msl) {
  StateVector x;
  x << trim.v_AB_B, trim.w_NB_B, trim.roll, trim.pitch, altitude_msl;
  InputVector in;
  in << trim.surfaces.aileron, trim.surfaces.elevator, trim.surfaces.rudder, trim.thrust;
  LinearModel linear;
  const auto slope = [](const auto& at, double step) -> StateVector {
    return (at(step) - at(-step)) / (2 * step);
  };
  const double airspeed = trim.v_AB_B.norm();
  for (int k = 0; k < LinearModel::kStates; ++k) {
    // Small against what each is measured by, large against rounding.
    const double step = k <= LinearModel::kW        ? 1e-5 * airspeed
                        : k == LinearModel::kHeight ? 0.1
                                                    : 1e-5;
    linear.A.col(k) = slope(
        [&](double d) -> StateVector {
          StateVector moved = x;
          moved[k] += d;
          return rate(model, moved, in);
        },
        step);
  }
  for (int k = 0; k < LinearModel::kInputs; ++k) {
    const double step =
        k == LinearModel::kThrust ? 1e-5 * kGravity * model.body.mass() : 1e-5;
    linear.B.col(k) = slope(
        [&](double d) -> StateVector {
          InputVector moved = in;
          moved[k] += d;
          return rate(model, x, moved);
        },
        step);
  }
  return linear;
}

Modes modes(const LinearModel& linear) {
  using L = LinearModel;
  Modes modes;
  const auto along =
      eigenvalues(picked(linear, {L::kU, L::kW, L::kQ, L::kPitch, L::kHeight}));
  modes.short_period = {along[0], along[1]};
  modes.phugoid = {along[2], along[3]};
  modes.height = along[4].real();

  auto across = eigenvalues(picked(linear, {L::kV, L::kP, L::kR, L::kRoll}));
  // The dutch roll is the fastest pair.
  const auto pair = std::find_if(across.begin(), across.end(),
                                 [](const auto& z) { return z.imag() > 0; });
  if (pair == across.end()) {
    // Overdamped: of four real ones the two in the middle.
    modes.roll = across[0].real();
    modes.dutch_roll = {across[1], across[2]};
    modes.spiral = across[3].real();
    return modes;
  }
  modes.dutch_roll = {pair[0], pair[1]};
  across.erase(pair, pair + 2);
  if (across[0].imag() != 0) {
    modes.roll_spiral = Modes::Pair{across[0], across[1]};
  } else {
    modes.roll = across[0].real();
    modes.spiral = across[1].real();
  }
  return modes;
}

}  // namespace skein::asset
