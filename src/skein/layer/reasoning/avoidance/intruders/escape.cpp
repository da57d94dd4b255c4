// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/intruders/escape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/math.h"
#include "skein/geo/rotation.h"

namespace skein::reasoning {
namespace {

constexpr int kCourses = 24;         // that are looked at, the own one among them
constexpr double kEscapeAhead = 30;  // that is looked at [s]
constexpr double kEscapeStep = 0.5;  // [s]
constexpr double kAsGood = 0.95;  // of the largest distance: the course nearer to the own

// A turn at once, then straight on.
class Turned {
 public:
  Turned(const Vec2& p, const Vec2& v, double radius, double turn)
      : p_(p), speed_(v.norm()), course_(geo::bearing(v)), turn_(turn) {
    rate_ = speed_ / std::max(1.0, radius);
    lasts_ = rate_ > 0 ? std::abs(turn) / rate_ : 0;
  }

  Vec2 at(double t) const {
    const double turning = std::min(t, lasts_), side = turn_ < 0 ? -1 : 1;
    const double angle = rate_ * turning;
    Vec2 place = p_;
    if (angle > 0) {
      const double radius = speed_ / rate_;
      const Vec2 along = geo::unit(course_);
      place += radius * (math::sin(angle) * along +
                         side * (1 - math::cos(angle)) * geo::turned_right(along));
    }
    return place + speed_ * (t - turning) * geo::unit(course_ + side * angle);
  }

 private:
  Vec2 p_;
  double speed_, course_, turn_, rate_ = 0, lasts_ = 0;
};

struct Nearest {
  double distance = math::kInfinity;  // [m]
  double higher = 0;  // the intruder than the own aircraft if that stays level [m]
};

Nearest nearest_on(const Turned& flight, double down,
                   std::span<const AvoidedIntruder> intruders, double now) {
  Nearest nearest;
  for (double t = 0; t <= kEscapeAhead; t += kEscapeStep)
    for (const AvoidedIntruder& each : intruders) {
      const Vec3 place = each.p_N + (now + t - each.time) * each.v_N;
      const double distance = (place.head<2>() - flight.at(t)).norm();
      if (distance < nearest.distance) nearest = {distance, down - place.z()};
    }
  return nearest;
}

}  // namespace

Escape escape_from(const Vec3& p_N, const Vec3& v_N, const FlightLimits& limits,
                   std::span<const AvoidedIntruder> intruders, double now) {
  const Vec2 v = v_N.head<2>();
  std::array<Nearest, kCourses> all;
  const auto turn_of = [](int k) { return geo::wrap_pi(2 * geo::kPi * k / kCourses); };
  double farthest = 0;
  for (int k = 0; k < kCourses; ++k) {
    const Turned flight(p_N.head<2>(), v, limits.turn_radius, turn_of(k));
    Nearest& nearest = all[static_cast<std::size_t>(k)];
    nearest = nearest_on(flight, p_N.z(), intruders, now);
    farthest = std::max(farthest, nearest.distance);
  }
  int best = -1;
  for (int k = 0; k < kCourses; ++k) {
    if (all[static_cast<std::size_t>(k)].distance < kAsGood * farthest) continue;
    if (best < 0 || std::abs(turn_of(k)) < std::abs(turn_of(best))) best = k;
  }
  best = std::max(best, 0);
  return {geo::wrap_pi(geo::bearing(v) + turn_of(best)),
          all[static_cast<std::size_t>(best)].higher <= 0};
}

}  // namespace skein::reasoning
