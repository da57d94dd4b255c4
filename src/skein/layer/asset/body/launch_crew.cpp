// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/body/launch_crew.h"

namespace skein::asset {
namespace {

constexpr double kPower = 0.5;      // throttle with which it rolls
constexpr double kFullPower = 0.9;  // and with which it is thrown
constexpr double kCalm = 1.5;       // air that matters little [m/s]
constexpr double kHeadwind = 1.4;   // that helps, where there is wind [m/s]
constexpr double kAhead = 0.7;      // of the wind, that blows along the nose

bool is_good_to_throw(const VehicleState& state, const Vec3& wind_N) {
  const double head = -wind_N.dot(state.q_NB * Vec3::UnitX());
  const double all = wind_N.norm();
  return all < kCalm || (head > kHeadwind && head > kAhead * all);
}

}  // namespace

std::vector<ParameterError> errors(const HandLaunch& launch) {
  ParameterCheck check;
  check.above("speed", launch.speed, 0);
  check.within("pitch", launch.pitch, 0, geo::kPi / 3);
  check.above("height", launch.height, 0);
  check.above("reach", launch.reach, 0);
  return check.take();
}

bool hold(const std::optional<HandLaunch>& launch, VehicleState& state, double throttle,
          const Vec3& wind_N, double dt) {
  const bool pushed = !state.v_N.isZero();
  if (!pushed && throttle < (launch ? kFullPower : kPower)) return true;
  if (!pushed && launch && !is_good_to_throw(state, wind_N)) return true;
  if (launch && state.v_N.norm() < launch->speed) {
    const double push = launch->speed * launch->speed / (2 * launch->reach);
    const Vec3 before = state.v_N;
    state.v_N += push * dt * (state.q_NB * Vec3::UnitX());
    state.p_N += 0.5 * dt * (before + state.v_N);
    return true;
  }
  state.held = false;
  return false;
}

}  // namespace skein::asset
