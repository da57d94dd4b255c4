// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/estimator/motion_history.h"

#include "skein/data/vehicle/air.h"
#include "skein/geo/rotation.h"

namespace skein::autopilot {

void MotionHistory::correct(Time now, const Vec3& v_before, const Vec3& dp,
                            const Vec3& dv, const Vec3& dtheta, const Vec3& da) {
  for (std::size_t i = 0; i < size_; ++i) {
    Entry& e = entries_[(newest_ + kMax - i) % kMax];
    const double age = (now - e.time).seconds();
    Vec3 gained = v_before - e.motion.v_N;
    gained.z() -= age * kGravity;
    const Vec3 turned = dtheta.cross(gained) - age * da;
    e.motion.v_N += dv - turned;
    e.motion.p_N += dp - age * (dv - 0.5 * turned);
  }
}

std::optional<MotionHistory::Motion> MotionHistory::at(Time t, Time now,
                                                       const Motion& present) const {
  Time after_time = now;
  const Motion* after = &present;
  for (std::size_t age = 0; age < size_; ++age) {
    const Entry& e = entry(age);
    if (e.time <= t) {
      const double span = (after_time - e.time).seconds();
      const double share = span > 0 ? (t - e.time).seconds() / span : 1;
      return Motion{e.motion.p_N + share * (after->p_N - e.motion.p_N),
                    e.motion.v_N + share * (after->v_N - e.motion.v_N)};
    }
    after_time = e.time;
    after = &e.motion;
  }
  if (t >= now) return present;
  return std::nullopt;
}

}  // namespace skein::autopilot
