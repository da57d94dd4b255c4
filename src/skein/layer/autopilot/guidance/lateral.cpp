// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/lateral.h"

#include "skein/base/math.h"

namespace skein::autopilot {

GroundMotion ahead_of(const GroundMotion& motion, double lag) {
  const double speed = motion.velocity.norm();
  if (speed < 1e-3) return motion;
  const Vec2 along = motion.velocity / speed;
  const double turned = std::clamp(lag * motion.lateral_acceleration / speed, -0.5, 0.5);
  // A small rotation: (1 - x^2/2, x) scaled to unit length.
  const double c = 1 - turned * turned / 2;
  const Vec2 next = (c * along + turned * geo::turned_right(along)) /
                    std::sqrt(c * c + turned * turned);
  GroundMotion then = motion;
  then.velocity = speed * next;
  then.position += lag / 2 * (motion.velocity + then.velocity);
  return then;
}

double turn_towards(const Vec2& setpoint, const Vec2& velocity, double gain) {
  const double across = geo::cross(velocity, setpoint);  // V sin(eta)
  if (velocity.dot(setpoint) >= 0) return gain * across;
  return gain * std::copysign(velocity.norm(), across);
}

double course_law(const model::TrackPoint& line, double cross_track, const Vec2& velocity,
                  const CourseLawOptions& options) {
  const double speed = velocity.norm();
  const double reach = options.look_ahead * speed;
  const double length = std::sqrt(reach * reach + cross_track * cross_track);
  if (length < 1e-6) return 0;
  const double cosine = reach / length;
  const Vec2 setpoint =
      cosine * line.tangent - cross_track / length * geo::turned_right(line.tangent);
  const double shrink = std::max(1 - line.curvature * cross_track, 0.2);
  return turn_towards(setpoint, velocity, options.gain) +
         line.curvature * speed * speed * cosine / shrink;
}

Sight l1_sight(const L1Options& options) {
  const double gain = 4 * options.damping * options.damping;
  return {options.damping * options.period / geo::kPi,
          1,
          gain,
          gain - 2,
          math::cos(options.intercept),
          math::sin(options.intercept)};
}

Sight l2_plus_sight(const L2PlusOptions& options) {
  return {options.time,
          options.min,
          2,
          2,
          math::cos(options.intercept),
          math::sin(options.intercept)};
}

CircleLine CircleLine::nearest_to(const Vec2& p, const Vec2& centre, double radius,
                                  bool clockwise) {
  const Vec2 off = p - centre;
  const double distance = off.norm();
  const Vec2 out = distance > 1e-6 ? Vec2(off / distance) : Vec2(1, 0);
  return {centre, radius, clockwise ? 1.0 : -1.0, out};
}

model::TrackPoint CircleLine::at(double ahead) const {
  const double turned = side * ahead / radius;
  const double c = math::cos(turned), s = math::sin(turned);
  const Vec2 there(c * out.x() - s * out.y(), s * out.x() + c * out.y());
  return {centre + radius * there, side * geo::turned_right(there), side / radius};
}

Vec2 CircleLine::turn_onto(double distance) const {
  const double sine = std::min(radius / distance, 1.0);
  return side * sine * geo::turned_right(out) - std::sqrt(1 - sine * sine) * out;
}

model::TrackPoint CircleLine::nearest() const {
  return {centre + radius * out, side * geo::turned_right(out), side / radius};
}

}  // namespace skein::autopilot
