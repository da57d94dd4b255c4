// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance.h"

#include <algorithm>

#include "skein/base/math.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::autopilot {

double turn_rate_for(const CourseDemand& demand, const Motion& motion,
                     const GuidanceOptions& options) {
  // When no heading makes good the course, point along it and drift.
  const double heading =
      model::heading_for_course(demand.course, motion.airspeed, motion.wind)
          .value_or(demand.course);
  const Vec2 ground = motion.airspeed * geo::unit(motion.heading) + motion.wind;
  // V_a cos(chi - psi) V_g = airspeed times the ground velocity along the heading.
  const double along =
      std::max(ground.dot(geo::unit(motion.heading)), 0.2 * motion.airspeed);
  const double forward = demand.rate * ground.squaredNorm() / (motion.airspeed * along);
  return options.heading_gain * geo::wrap_pi(heading - motion.heading) + forward;
}

CourseDemand track(double course, double curvature, double cross_track,
                   double ground_speed, const GuidanceOptions& options) {
  const double correction = -math::atan2(cross_track, options.look_ahead * ground_speed);
  // Near the centre of an arc its parallel has no radius: stay at a fifth.
  const double shrink = std::max(1 - curvature * cross_track, 0.2);
  return {course + correction, curvature * ground_speed * math::cos(correction) / shrink};
}

CourseDemand circle(const Circle& circle, const Vec2& position, double ground_speed,
                    const GuidanceOptions& options) {
  const Vec2 out = position - circle.centre;
  const double side = circle.clockwise ? 1 : -1;
  const double course = geo::bearing(out) + side * geo::kPi / 2;
  // The centre is on the side of the turn: outside of the circle means left of it.
  const double cross_track = -side * (out.norm() - circle.radius);
  return track(course, side / circle.radius, cross_track, ground_speed, options);
}

}  // namespace skein::autopilot
