// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/plan.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein::reasoning {

/// What a follower knows of the motion of its leader.
struct LeaderMotion {
  NavEstimate at;        ///< last received
  double turn_rate = 0;  ///< of its course [rad/s]
};

/// The place of a follower `after` seconds after its leader was at `leader.at`.
///
/// The leader goes on at its speed and turns on evenly, by a quarter turn at most: where
/// its turn ends is not known, and more is seldom. The offset turns with its course.
///
///   course' = turn_rate,   p' = v,   slot = p + R(course) offset
///
/// @param offset  ahead of the leader and to its right [m].
/// @returns       position and velocity of the slot. It climbs on as the leader does for
///                two seconds: longer, gusts would be taken for climbs.
PlanPoint slot_at(const LeaderMotion& leader, const Vec2& offset, double after);

/// The path of a follower from where it is to its slot, as an aircraft with these limits
/// can fly it.
///
/// A point with the follower's place and speed is carried on for `horizon` seconds by
///
///   v_wanted = v_slot + ahead c(e_ahead) + right clamp(k_r e_right),
///   c(e) = sign(e) min(k_a |e|, sqrt(2 a |e|))
///
/// where e is the distance to the slot along the leader's course and across it, and a a
/// deceleration that slow aircraft have too; its airspeed keeps within [slowest, fastest]
/// and changes slowly, its lateral acceleration keeps below the bank limit. So what
/// cannot be kept (the slot outside of a turn may be faster than any aircraft) is caught
/// up as fast as the follower flies, and the plan can always be flown. What can hover
/// (slowest = 0) moves to any side instead.
///
/// @param own      the follower; its wind is the wind of the plan.
/// @returns        points from own.time on.
Plan plan_to_slot(const NavEstimate& own, const LeaderMotion& leader, const Vec2& offset,
                  const FlightLimits& limits, double horizon);

}  // namespace skein::reasoning
