// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/same_guidance.h"

#include <algorithm>

namespace skein::autopilot {
namespace {

bool same(const FollowPath& a, const FollowPath& b) {
  return std::equal(a.path.begin(), a.path.end(), b.path.begin(), b.path.end(),
                    [](const PathElement& x, const PathElement& y) {
                      return x.start == y.start && x.course == y.course &&
                             x.length == y.length && x.curvature == y.curvature;
                    });
}

bool same(const FollowPlan& a, const FollowPlan& b) {
  return std::equal(a.plan.begin(), a.plan.end(), b.plan.begin(), b.plan.end(),
                    [](const PlanPoint& x, const PlanPoint& y) {
                      return x.time == y.time && x.p_N == y.p_N && x.v_N == y.v_N;
                    });
}

bool same(const FlyWaypoints& a, const FlyWaypoints& b) {
  return a.laps == b.laps &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    [](const auto& x, const auto& y) {
                      return x.point == y.point && x.altitude_msl == y.altitude_msl;
                    });
}

bool same(const TakeOff& a, const TakeOff& b) {
  return a.course == b.course;
}

bool same(const Land& a, const Land& b) {
  return a.point == b.point && a.ground_msl == b.ground_msl && a.course == b.course;
}

template <class T>
bool both(const AutopilotCommand& now, const AutopilotCommand& next) {
  const T *a = std::get_if<T>(&now.guidance), *b = std::get_if<T>(&next.guidance);
  return a && b && same(*a, *b);
}

}  // namespace

bool same_guidance(const AutopilotCommand& now, const AutopilotCommand& next) {
  return both<FollowPath>(now, next) || both<FollowPlan>(now, next) ||
         both<FlyWaypoints>(now, next) || both<TakeOff>(now, next) ||
         both<Land>(now, next);
}

bool has_own_altitude(const AutopilotCommand& command) {
  return std::holds_alternative<FollowPlan>(command.guidance) ||
         std::holds_alternative<FlyWaypoints>(command.guidance) ||
         std::holds_alternative<Land>(command.guidance);
}

}  // namespace skein::autopilot
