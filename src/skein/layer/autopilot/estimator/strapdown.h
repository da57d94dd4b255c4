// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/air.h"
#include "skein/layer/autopilot/estimator/error_covariance.h"
#include "skein/layer/autopilot/estimator/error_state.h"

namespace skein::autopilot {

/// Moves position, velocity and attitude on by one inertial sample, mean rate `w_B` and
/// mean specific force `f_B` over `dt`, without their errors:
///
///   q_mid = q Exp(w dt / 2),  q+ = q_mid Exp(w dt / 2)
///   v+ = v + (R(q_mid) f + g) dt,  p+ = p + (v + v+) dt / 2
///
/// and adds the step to the integrals A, C and s of `interval`, and to its dt.
/// Valid: flat Earth that does not turn.
void strapdown(Navigated& x, Interval& interval, const Vec3& w_B, const Vec3& f_B,
               double dt);

}  // namespace skein::autopilot
