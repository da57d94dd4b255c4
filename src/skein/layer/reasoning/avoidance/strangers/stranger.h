#pragma once

#include <cstdint>
#include <optional>

#include "skein/data/airspace.h"
#include "skein/data/flight_plan.h"
#include "skein/data/separation.h"

namespace skein::reasoning {

/// Another aircraft whose plans are not known: it is where a track or its own reports
/// say, and is expected to go straight on.
struct Stranger {
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

/// How well a stranger's place is known some seconds later, when it may accelerate:
///
///   s(t)^2 = s_p^2 + (s_v t)^2 + q^2 t^3 / 3,  q = 1.5 m/s^2 per sqrt(Hz), 0.7 up and
///   down
///
/// the same motion that tracks are filtered with, t at most 10 s: what a stranger does
/// later is seen in time to plan again, and room for all of it would take longer to fly
/// around than the whole way.
double horizontal_sd_after(const Stranger& stranger, double t);
double vertical_sd_after(const Stranger& stranger, double t);

/// Where and when a planned flight and a stranger will not be apart.
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
std::optional<PredictedIntersection> predicted_intersection(const FlightPlan& plan,
                                                            const Stranger& stranger,
                                                            double now,
                                                            double sigmas = 2);

/// Its flight if it goes straight on, from a time to another [s].
FlightPlan flight_of(const Stranger& stranger, double from, double until);

/// The room that is kept free of the own flight: a cylinder that moves with the stranger,
/// from five seconds before the intersection to five after.
MovingObstacle room_of(const Stranger& stranger, const PredictedIntersection& meeting);

}  // namespace skein::reasoning
