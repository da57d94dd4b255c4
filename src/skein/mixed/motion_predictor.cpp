// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/motion_predictor.h"

#include <algorithm>

namespace skein::mixed {
namespace {

constexpr double kPredicted = 0.2;  // at most [s]
// Between two motions that give an acceleration [s].
constexpr double kMinGap = 0.002, kMaxStateGap = 0.3;
constexpr double kMaxAcceleration = 40;  // of what flies [m/s^2]

}  // namespace

void MotionPredictor::add(const VehicleMotion& motion) {
  a_N_ = Vec3::Zero();
  if (newest_) {
    const double dt = (motion.time - newest_->time).seconds();
    const Vec3 change = motion.v_N - newest_->v_N;
    if (dt >= kMinGap && dt <= kMaxStateGap && change.norm() <= kMaxAcceleration * dt)
      a_N_ = change / dt;
  }
  newest_ = motion;
}

VehicleMotion MotionPredictor::at(Time now) const {
  VehicleMotion m = *newest_;
  const double t = std::clamp((now - m.time).seconds(), -kPredicted, kPredicted);
  m.p_N += t * m.v_N + t * t / 2 * a_N_;
  m.v_N += t * a_N_;
  m.q_NB = m.q_NB * geo::exp_so3(t * m.w_NB_B);
  m.time = now;
  return m;
}

}  // namespace skein::mixed
