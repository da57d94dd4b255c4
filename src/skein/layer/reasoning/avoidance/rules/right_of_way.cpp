// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/rules/right_of_way.h"

#include <cmath>

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

constexpr double kHeadOn = 150 * geo::kPi / 180;  // between the courses, at least
constexpr double kSameWay = 70 * geo::kPi / 180;  // at most
constexpr double kSlow = 3;                       // of closing [m/s]
constexpr double kClimbs = 0.5;                   // faster up or down than level [m/s]

// How fast the horizontal distance shrinks [m/s].
double closing(const AirMotionState& own, const AirMotionState& other) {
  const Vec2 p = (other.p_N - own.p_N).head<2>();
  const Vec2 v = (other.v_N - own.v_N).head<2>();
  const double distance = p.norm();
  return distance > 0 ? -p.dot(v) / distance : 0;
}

}  // namespace

AirRule rule_for(const AirMotionState& own, const AirMotionState& other,
                 Standing standing, bool own_id_lower) {
  if (standing == Standing::kOwnHigher) return AirRule::kPreferred;
  if (standing == Standing::kOtherHigher) return AirRule::kUnable;
  const bool own_climbs = std::abs(own.v_N.z()) > kClimbs;
  const bool other_climbs = std::abs(other.v_N.z()) > kClimbs;
  if (own_climbs != other_climbs)
    return own_climbs ? AirRule::kClimbing : AirRule::kLevel;
  const double course = geo::bearing(own.v_N.head<2>());
  const double turned = geo::wrap_pi(geo::bearing(other.v_N.head<2>()) - course);
  if (std::abs(turned) > kHeadOn) return AirRule::kHeadOn;
  if (closing(own, other) < kSlow)
    return own_id_lower ? AirRule::kSlowHigher : AirRule::kSlowLower;
  const Vec2 to_other = (other.p_N - own.p_N).head<2>();
  const double bearing = geo::wrap_pi(geo::bearing(to_other) - course);
  const double own_bearing =
      geo::wrap_pi(geo::bearing(-to_other) - geo::bearing(other.v_N.head<2>()));
  if (std::abs(turned) < kSameWay) {
    const bool own_behind = std::abs(own_bearing) > geo::kPi / 2;
    const bool other_behind = std::abs(bearing) > geo::kPi / 2;
    if (own_behind != other_behind)
      return own_behind ? AirRule::kOvertaking : AirRule::kOvertaken;
  }
  // Each has the other to its left: they pass like two that meet head-on.
  if (bearing < 0 && own_bearing < 0) return AirRule::kHeadOn;
  // What lies dead ahead or astern of both is from the right of the higher id.
  if (bearing == 0) return own_id_lower ? AirRule::kFromLeft : AirRule::kFromRight;
  return bearing > 0 ? AirRule::kFromRight : AirRule::kFromLeft;
}

}  // namespace skein::reasoning
