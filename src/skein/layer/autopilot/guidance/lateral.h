// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "skein/geo/vec.h"
#include "skein/model/path/path_cursor.h"

namespace skein::autopilot {

// Lateral guidance laws. Each gives the acceleration across the ground track [m/s^2],
// right positive, that leads onto a line and along it. Written with vectors: no angle
// functions. V = ground speed, t = unit tangent of the line at the nearest point, n = to
// its right, e = cross-track (right positive), kappa = curvature (right positive).

enum class LateralLaw {
  kCourse,  ///< course to the line, with the turn of the line fed forward
  kL1,      ///< a point of the line at a fixed time and damping: [Park07]
  kL2Plus,  ///< line of sight that grows with the speed: [Curry13]
};

struct CourseLawOptions {
  double gain = 1.2;      ///< rate of turn per sine of the course error [1/s]
  double look_ahead = 3;  ///< flight time in which a cross-track error is taken out [s]
};

struct L1Options {
  double period = 10;      ///< of the small motion about a straight line [s]
  double damping = 0.75;   ///< of it, as a ratio
  double intercept = 0.8;  ///< largest angle towards the line, from far away [rad]
};

struct L2PlusOptions {
  double time = 2.5;       ///< T*: flight time to the point aimed at [s]
  double min = 10;         ///< minimum distance of that point [m]
  double intercept = 1.1;  ///< angle towards the line from further away than it [rad]
};

struct LateralOptions {
  LateralLaw law = LateralLaw::kL2Plus;
  CourseLawOptions course;
  L1Options l1;
  L2PlusOptions l2;
  /// Time from a change of the demand to the acceleration [s]: where the vehicle will be
  /// then is what the law is applied to.
  double roll_lag = 0.35;
};

/// Motion over ground, as lateral guidance sees it.
struct GroundMotion {
  Vec2 position = Vec2::Zero();     ///< [m]
  Vec2 velocity = Vec2::Zero();     ///< [m/s]
  double lateral_acceleration = 0;  ///< across the velocity now, right positive [m/s^2]
};

/// The motion after `lag` [s] of unchanged acceleration, to second order; the speed
/// stays.
GroundMotion ahead_of(const GroundMotion& motion, double lag);

/// The acceleration that turns the velocity to `setpoint` (a unit vector).
///
///   a = k V sin(eta),  eta = from the velocity to `setpoint`; beyond a right angle sin =
///   +-1
double turn_towards(const Vec2& setpoint, const Vec2& velocity, double gain);

/// Course law.
///
///   chi_d = chi_p - atan(e / (s V)),   a = k V sin(chi_d - chi) + kappa V^2 c / (1 -
///   kappa e)
///
/// with c = cos(chi_d - chi_p). Exact on lines and circles: with e = 0 and the right
/// course it gives kappa V^2, in any steady wind, because V is over ground.
/// @param line  the line at the nearest point.
/// Valid:       within 0.8 of an arc's radius of it; further inside as there.
double course_law(const model::TrackPoint& line, double cross_track, const Vec2& velocity,
                  const CourseLawOptions& options);

/// What a line of sight law aims with.
struct Sight {
  double time = 1;   ///< L = max(time V, least): distance to the point aimed at
  double min = 1;    ///< [m]
  double gain = 2;   ///< K: a = K V^2 / L sin(eta)
  double leads = 0;  ///< M: how much of a turn of the line is given, not seen; 0 to K
  double cosine = 0, sine = 1;  ///< of the intercept angle

  double distance(double ground_speed) const {
    return std::max(time * ground_speed, min);
  }
};

/// [Park07] with the period T and damping ratio zeta of the small motion about a line:
///
///   L = zeta T V / pi,   K = 4 zeta^2,   M = K - 2      (Park's: K = 2, zeta = 1/sqrt 2)
///
/// About a straight line sin(eta) = -e/L - e'/V, so e'' + K V/L e' + K V^2/L^2 e = 0: the
/// frequency is 2 pi / T and the damping zeta. Turns begin when the point aimed at turns.
Sight l1_sight(const L1Options& options);

/// [Curry13] L = max(T* V, least), K = 2, so a = 2 V sin(eta) / T*; with M = K: turns
/// begin where the line does.
Sight l2_plus_sight(const L2PlusOptions& options);

/// Line of sight law.
///
///   a = K V^2 / L sin(eta) - M V^2 / L sin(eta_p) + (M - K + 2) / 2 kappa V^2
///
/// eta is the angle from the velocity to the point aimed at, L its true distance; eta_p
/// is the angle at which an aircraft on the line sees it. The point lies sqrt(L^2 - e^2)
/// along the line. On a circle the angle between chord and tangent is asin(L kappa / 2):
/// the law gives exactly kappa V^2 there for any K and M. With M = K this is so on any
/// line, also where its curvature steps: an aircraft on the line stays there. Further
/// from the line than L sin(intercept) there is no such point, or it would be approached
/// too steeply: then the aim is the intercept angle to the line. On straights both join
/// evenly.
///
/// @param line  anything with `TrackPoint at(double ahead)`: its point `ahead` metres
///              from the nearest one.
template <class Line>
double sight_law(const Sight& sight, const Line& line, const model::TrackPoint& nearest,
                 double cross_track, const GroundMotion& motion) {
  const double speed = motion.velocity.norm();
  const double reach = sight.distance(speed);
  const double off = std::abs(cross_track);
  if (off >= reach * sight.sine) {
    const Vec2 right = geo::turned_right(nearest.tangent);
    const Vec2 setpoint =
        sight.cosine * nearest.tangent - std::copysign(sight.sine, cross_track) * right;
    return turn_towards(setpoint, motion.velocity, sight.gain * speed / reach);
  }
  const double ahead = std::sqrt(reach * reach - off * off);
  const Vec2 target = line.at(ahead).position;
  const Vec2 to = target - motion.position;
  const double length = std::max(to.norm(), 1e-9);
  // On the inside of a turn the point comes nearer; half the distance bounds the gain.
  const double gain = sight.gain * speed / std::max(length, reach / 2);
  double a = turn_towards(to / length, motion.velocity, gain);
  if (sight.leads != 0) {
    const Vec2 seen = target - nearest.position;
    const double chord = std::max(seen.norm(), 1e-9);
    a -= sight.leads * speed * speed / std::max(chord, reach / 2) *
         geo::cross(nearest.tangent, seen) / chord;
  }
  return a + (sight.leads - sight.gain + 2) / 2 * nearest.curvature * speed * speed;
}

/// A circle as a line to follow, seen from outside or inside. From far outside the path
/// leads straight to where the tangent touches it, not at an angle to the nearest
/// tangent.
struct CircleLine {
  Vec2 centre = Vec2::Zero();
  double radius = 1;      ///< [m]
  double side = 1;        ///< +1 clockwise on the map, -1 counter-clockwise
  Vec2 out = Vec2(1, 0);  ///< unit vector from the centre to the nearest point

  /// The circle with its point nearest to `p`.
  static CircleLine nearest_to(const Vec2& p, const Vec2& centre, double radius,
                               bool clockwise);
  /// The point `ahead` metres along the circle from the nearest one.
  model::TrackPoint at(double ahead) const;
  /// The nearest point itself.
  model::TrackPoint nearest() const;
  double cross_track(const Vec2& p) const {
    return -side * ((p - centre).dot(out) - radius);
  }
  /// Course from `distance` [m] from the centre, beyond the radius, on `out`, to the
  /// point at which it goes over into the circle; a unit vector.
  Vec2 turn_onto(double distance) const;
};

}  // namespace skein::autopilot
