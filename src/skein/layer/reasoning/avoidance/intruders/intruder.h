// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "skein/data/airspace/airspace.h"
#include "skein/data/traffic/separation.h"
#include "skein/data/vehicle/flight_plan.h"

namespace skein::reasoning {

/// Another aircraft whose plans are not known: it is where a track or its own reports
/// say, and is expected to go straight on.
struct AvoidedIntruder {
  /// Names it from step to step: the number of its track.
  std::uint32_t name = 0;
  double time = 0;          ///< that the rest is of [s]
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  /// Standard deviations of position [m] and velocity [m/s], horizontally in the worst
  /// direction, and up and down.
  double horizontal_sd = 0, horizontal_speed_sd = 0;
  double vertical_sd = 0, vertical_speed_sd = 0;
  /// What is kept to it.
  Separation kept = {609.6, 76.2};
};

/// Which room of an intruder that comes near the own plan is kept free.
enum class IntruderRoom : std::uint8_t {
  kMoving,  ///< what is around it, wherever it is: room_of()
  kStatic,  ///< where it is while it is too near: static_room_of()
};
constexpr auto names_of(const IntruderRoom*) {
  return std::to_array<std::string_view>({"moving", "static"});
}

/// How well an intruder's place is known some seconds later, when it may accelerate:
///
///   s(t)^2 = s_p^2 + (s_v t)^2 + q^2 t^3 / 3,  q = 1.5 m/s^2 per sqrt(Hz), 0.7 up and
///   down
///
/// the same motion that tracks are filtered with, t at most 10 s: what an intruder does
/// later is seen in time to plan again, and room for all of it would take longer to fly
/// around than the whole way.
double horizontal_sd_after(const AvoidedIntruder& intruder, double t);
double vertical_sd_after(const AvoidedIntruder& intruder, double t);

/// Where and when a planned flight and an intruder will not be apart.
struct PredictedIntersection {
  double ratio = 1;         ///< least distance over what is to be kept
  double begin = 0;         ///< when it is first below 1 [s]
  double closest_time = 0;  ///< when it is least [s]
  double end = 0;           ///< when it was last below 1 [s]
  Separation kept;          ///< D + k s_h, Z + k s_z at the closest time
};

/// Looks along a plan from `now` for a minute:
///
///   t* = argmin max(h(t) / (D + k s_h(t)), z(t) / (Z + k s_z(t)))
///
/// @param sigmas  k.
/// @returns  none where the least is 1 or more.
/// Reference: spec/team.md section 8.
std::optional<PredictedIntersection> predicted_intersection(
    const FlightPlan& plan, const AvoidedIntruder& intruder, double now,
    double sigmas = 2);

/// Its flight if it goes straight on, from a time to another [s].
FlightPlan flight_of(const AvoidedIntruder& intruder, double from, double until);

/// The room that is kept free of the own flight: a cylinder that moves with the intruder,
/// from five seconds before the intersection to five after.
MovingObstacle room_of(const AvoidedIntruder& intruder,
                       const PredictedIntersection& encounter);

/// The room that is kept free instead of the one that moves: all that the intruder's
/// surroundings sweep from when the two come too near until they are apart, as an ellipse
/// along its course,
///
///   a = D + k s_h + V (t_2 - t_1) / 2,  b = D + k s_h,
///
/// around where it is in the middle of that time, and Z + k s_z above the highest and
/// below the lowest place of it. It is there from five seconds before the intersection to
/// five after: one that were there from the first would already be around an aircraft
/// that meets a faster one head-on.
///
/// @returns  a ring of 24 corners around the ellipse, nowhere more than 1 % outside.
/// Reference: spec/team.md section 8; [Sislak11].
Zone static_room_of(const AvoidedIntruder& intruder,
                    const PredictedIntersection& encounter);

}  // namespace skein::reasoning
