// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/encounter/relative_motion.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace skein::reasoning::relative_motion_test {
namespace {

const Separation kApart{50, 20};

double number(int max) {
  return *rc::gen::inRange(-1000 * max, 1000 * max) / 1000.0;
}

RelativeMotion any_motion() {
  RelativeMotion motion;
  motion.p_N = {number(300), number(300), number(60)};
  motion.v_N = {number(40), number(40), number(4)};
  if (*rc::gen::inRange(0, 4) == 0) motion.v_N.z() = 0;
  if (*rc::gen::inRange(0, 8) == 0) motion.v_N.head<2>().setZero();
  return motion;
}

double ratio_at(const RelativeMotion& motion, double t) {
  const Vec3 p = motion.p_N + t * motion.v_N;
  return kApart.ratio(p.head<2>().norm(), std::abs(p.z()));
}

RC_GTEST_PROP(RelativeMotion, IsWithinExactlyInTheSpanItSays, ()) {
  const RelativeMotion motion = any_motion();
  const auto within = time_within(motion, 30, kApart);
  for (double t = 0.01; t < 30; t += 0.05) {
    const bool inside = within && t > within->begin && t < within->end;
    const double ratio = ratio_at(motion, t);
    if (std::abs(ratio - 1) > 1e-9) RC_ASSERT(inside == (ratio < 1));
  }
}

RC_GTEST_PROP(RelativeMotion, ComesNowhereNearerThanTheClosest, ()) {
  const RelativeMotion motion = any_motion();
  const Closest nearest = closest(motion, {3, 20}, kApart);
  RC_ASSERT(nearest.after >= 3 && nearest.after <= 20);
  RC_ASSERT(std::abs(ratio_at(motion, nearest.after) - nearest.ratio) < 1e-9);
  for (double t = 3; t <= 20; t += 0.05)
    RC_ASSERT(ratio_at(motion, t) >= nearest.ratio - 1e-9);
}

}  // namespace
}  // namespace skein::reasoning::relative_motion_test
