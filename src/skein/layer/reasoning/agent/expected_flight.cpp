// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/expected_flight.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/layer/reasoning/trajectory/altitude.h"
#include "skein/layer/reasoning/trajectory/drape.h"
#include "skein/layer/reasoning/trajectory/steering_flight.h"
#include "skein/model/connection/point_connection.h"
#include "skein/model/path/flight_plan.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::reasoning {
namespace {

constexpr double kSameCourse = 0.02;  // [rad]
constexpr double kMinAirspeed = 1;    // of what hovers, so that it has a heading [m/s]
constexpr double kSameAltitude = 2;   // of pieces of a flight over ground [m]
constexpr double kOnCircle = 0.3;     // beside it, of its radius
constexpr double kAlmostTangential = 0.5;  // [rad]
constexpr double kApproachPiece = 3;       // of a way onto a circle [s]
constexpr double kNearApproachPiece = 1;   // the same, nearer than its radius [s]
constexpr double kMinPiece = 0.1;          // [s]
constexpr double kMinSpeed = 0.5;          // over ground [m/s]
constexpr double kWindy = 0.15;            // of the airspeed
constexpr int kMaxPieces = 200;
constexpr double kNotCircled = 35;  // of the time asked for: each quarter costs bytes [s]
constexpr double kApproachHeight = 40;  // above the ground at the place [m]
constexpr double kInLine = 30;          // behind its begin: on the approach [m]

// A flight that grows piece by piece, level.
class Flight {
 public:
  Flight(const NavEstimate& nav, const model::AirMotion& air, double now)
      : nav_(nav), air_(air), now_(now) {}

  double duration() const { return model::duration(plan_); }
  double end() const { return now_ + duration(); }
  model::Pose at() const {
    if (plan_.empty()) return {geo::horizontal(nav_.p_N), nav_.heading};
    const model::FlightMoment m = model::end_of(plan_.back());
    return {geo::horizontal(m.p_N), m.heading};
  }

  void fly(double duration, double turn_rate) {
    if (!(duration > 0)) return;
    const model::Pose from = at();
    FlightElement e;
    e.start = now_ + this->duration();
    e.duration = duration;
    e.p_N = Vec3(from.position.x(), from.position.y(), nav_.p_N.z());
    e.heading = from.course;
    e.airspeed = air_.airspeed;
    e.turn_rate = turn_rate;
    e.wind = air_.wind;
    plan_.push_back(e);
  }

  void turn_to(double heading) {
    const double angle = geo::wrap_pi(heading - at().course);
    const double rate = air_.airspeed / air_.turn_radius;
    if (std::abs(angle) > kSameCourse)
      fly(std::abs(angle) / rate, std::copysign(rate, angle));
  }

  void fly_to(const Vec2& point) {
    const model::PointConnection path = model::connect_to_point(at(), point, air_);
    if (path.status != model::ConnectionStatus::kFound) return;
    model::append(
        plan_, model::to_flight_plan(path, at(), air_, now_ + duration(), nav_.p_N.z()));
  }

  // Around a point in the wind, from anywhere: as guidance does, tangentially on the
  // circle and towards it from afar, at first in short pieces, then in parts of it.
  void circle(const Circle& circle, double duration) {
    const double until = this->duration() + duration;
    for (int k = 0; k < kMaxPieces && until - this->duration() > kMinPiece; ++k) {
      const model::Pose from = at();
      const Vec2 out = from.position - circle.centre;
      const double off = out.norm() - circle.radius;
      const double turned = geo::wrap_pi(from.course - heading_along(circle, out));
      const bool on = std::abs(off) < kOnCircle * circle.radius &&
                      std::abs(turned) < kAlmostTangential;
      const double left = until - this->duration();
      const double piece =
          std::abs(off) < circle.radius ? kNearApproachPiece : kApproachPiece;
      if (on)
        part(circle, out, left);
      else
        approach(-turned, std::min(left, piece));
    }
  }

  FlightPlan take() { return std::move(plan_); }

 private:
  // The heading of one who circles and is `out` of the centre.
  double heading_along(const Circle& circle, const Vec2& out) const {
    const double turned =
        geo::kPi / 2 + math::atan2(out.norm() - circle.radius, circle.radius);
    const double course = geo::bearing(out) + (circle.clockwise ? turned : -turned);
    return model::heading_for_course(course, air_.airspeed, air_.wind).value_or(course);
  }

  // A turn by an angle, as far as it comes, then straight on.
  void approach(double angle, double time) {
    const double fastest = air_.airspeed / air_.turn_radius;
    const double turning = std::min(time, std::abs(angle) / fastest);
    if (turning > kMinPiece) fly(turning, std::copysign(fastest, angle));
    if (time - turning > kMinPiece) fly(time - turning, 0);
  }

  // A quarter of a circle, in more wind an eighth, or what there is time for.
  void part(const Circle& circle, const Vec2& out, double left) {
    const double side = circle.clockwise ? 1 : -1;
    const bool windy = air_.wind.norm() > kWindy * air_.airspeed;
    const double angle = geo::kPi / (windy ? 4 : 2);
    const auto ground_speed = [&](const Vec2& there) {
      return (air_.airspeed * geo::unit(heading_along(circle, there)) + air_.wind).norm();
    };
    const double bearing = geo::bearing(out);
    const auto place = [&](double turned) -> Vec2 {
      return circle.radius * geo::unit(bearing + side * turned);
    };
    const double speed = (ground_speed(out) + 4 * ground_speed(place(angle / 2)) +
                          ground_speed(place(angle))) /
                         6;
    if (!(speed > kMinSpeed)) return approach(0, left);
    const double time = circle.radius * angle / speed;
    const double turn = geo::wrap_pi(heading_along(circle, place(angle)) - at().course);
    fly(std::min(time, left), turn / time);
  }

  const NavEstimate& nav_;
  model::AirMotion air_;
  double now_;
  FlightPlan plan_;
};

// Climbs or sinks from the start on until an altitude is reached.
FlightPlan reaching(const FlightPlan& plan, double down, const FlightLimits& limits) {
  FlightPlan climbed;
  for (FlightElement e : plan) {
    if (!climbed.empty()) e.p_N.z() = model::end_of(climbed.back()).p_N.z();
    const double up = e.p_N.z() - down;
    const double rate = up > 0 ? limits.climb_rate : limits.sink_rate;
    const double time = rate > 0 ? std::abs(up) / rate : 0;
    if (time <= 0 || !(std::abs(up) > 0)) {
      climbed.push_back(e);
      continue;
    }
    FlightElement climbing = e;
    climbing.climb_rate = std::copysign(rate, up);
    climbing.duration = std::min(time, e.duration);
    climbed.push_back(climbing);
    if (time >= e.duration) continue;
    const model::FlightMoment m = model::end_of(climbing);
    FlightElement level = e;
    level.start += time;
    level.duration -= time;
    level.p_N = m.p_N;
    level.heading = m.heading;
    climbed.push_back(level);
  }
  return climbed;
}

class Expectation {
 public:
  Expectation(Flight& flight, const FlightContext& context, const NavEstimate& nav,
              std::size_t passed, double duration)
      : flight_(flight),
        context_(context),
        nav_(nav),
        passed_(passed),
        duration_(duration) {}

  std::optional<double> altitude_msl;
  std::vector<double> points;
  std::optional<double> stays_from;

  void operator()(const Steering& steering) {
    altitude_msl = steering.altitude_msl;
    if (const auto* circle = std::get_if<Circle>(&steering.guidance))
      return around(*circle);
    const double airspeed = std::max(context_.limits.airspeed, kMinAirspeed);
    flight_.turn_to(model::heading_for_course(steering.course, airspeed, nav_.wind_N)
                        .value_or(steering.course));
    flight_.fly(duration_ - flight_.duration(), 0);
  }
  void operator()(const Circling& circling) {
    altitude_msl = circling.altitude_msl;
    around(usual_circle(circling.centre));
  }
  void operator()(const Legs& legs) {
    altitude_msl = legs.altitude_msl;
    const std::size_t all = legs.points.size() * static_cast<std::size_t>(legs.laps);
    for (std::size_t k = passed_; k < all && flight_.duration() < duration_; ++k) {
      flight_.fly_to(legs.points[k % legs.points.size()]);
      points.push_back(flight_.end());
    }
    if (flight_.duration() >= duration_) return;
    stays_from = flight_.end();
    around(usual_circle(legs.points.back()));
  }
  void operator()(const Itinerary&) {}
  void operator()(const Landing& landing) {
    altitude_msl = landing.altitude_msl;
    // Autopilots come down to the height of the approach at once.
    if (landing.course && context_.limits.slowest > 0) {
      const Vec2 begin = landing.place - landing.approach * geo::unit(*landing.course);
      const Vec2 off = geo::horizontal(nav_.p_N) - begin;
      altitude_msl = context_.map->elevation_msl(landing.place) + kApproachHeight;
      if (off.dot(geo::unit(*landing.course)) < kInLine) flight_.fly_to(begin);
    }
    flight_.fly_to(landing.place);
  }
  void operator()(const Returning& returning) {
    altitude_msl = returning.altitude_msl;
    flight_.fly(duration_, 0);
  }

 private:
  Circle usual_circle(const Vec2& centre) const {
    return {centre, wide_radius(context_.limits, nav_.wind_N), true};
  }
  void around(const Circle& circle) {
    const Vec2 out = flight_.at().position - circle.centre;
    if (out.norm() > 2 * circle.radius)
      flight_.fly_to(circle.centre + 1.5 * circle.radius * out.normalized());
    flight_.circle(circle, duration_ - kNotCircled - flight_.duration());
  }

  Flight& flight_;
  const FlightContext& context_;
  const NavEstimate& nav_;
  std::size_t passed_;
  double duration_;
};

}  // namespace

ExpectedFlight expected_flight(const FlightIntent& intent, std::size_t passed,
                               const NavEstimate& nav, const FlightContext& context,
                               double now, double duration) {
  model::AirMotion air{std::max(context.limits.airspeed, kMinAirspeed),
                       context.limits.turn_radius, nav.wind_N};
  Flight flight(nav, air, now);
  Expectation expectation(flight, context, nav, passed, duration);
  std::visit(expectation, intent.what);
  FlightPlan plan = flight.take();
  plan = expectation.altitude_msl
             ? reaching(plan, -*expectation.altitude_msl, context.limits)
             : at_height_over_ground(plan, context, context.altitude_agl, nav.p_N.z());
  return {std::move(plan), std::move(expectation.points), expectation.stays_from};
}

FlightPlan at_height_over_ground(const FlightPlan& plan, const FlightContext& context,
                                 double height, double down) {
  if (plan.empty()) return plan;
  const Plan points = drape(plan, *context.map, height, context.limits, down);
  FlightPlan over;
  std::size_t from = 0;
  // As few pieces as stay within the altitudes of all points between their ends.
  const auto straight = [&](std::size_t end) {
    const double t0 = points[from].time.seconds(), t1 = points[end].time.seconds();
    for (std::size_t k = from + 1; k < end; ++k) {
      const double share = (points[k].time.seconds() - t0) / (t1 - t0);
      const double z =
          points[from].p_N.z() + share * (points[end].p_N.z() - points[from].p_N.z());
      if (std::abs(z - points[k].p_N.z()) > kSameAltitude) return false;
    }
    return true;
  };
  for (const FlightElement& e : plan) {
    double time = e.start;
    while (time < e.start + e.duration - 1e-6) {
      while (from + 1 < points.size() && points[from + 1].time.seconds() <= time + 1e-6)
        ++from;
      std::size_t end = from;
      while (end + 1 < points.size() &&
             points[end].time.seconds() < e.start + e.duration - 1e-6 &&
             (end == from || straight(end + 1)))
        ++end;
      const model::FlightMoment m = model::moment(e, time - e.start);
      FlightElement piece = e;
      piece.start = time;
      piece.p_N = m.p_N;
      piece.heading = m.heading;
      piece.climb_acceleration = 0;
      if (end == from) {
        piece.duration = e.start + e.duration - time;
        piece.climb_rate = 0;
        piece.p_N.z() = points[from].p_N.z();
      } else {
        const double t0 = points[from].time.seconds(), t1 = points[end].time.seconds();
        piece.climb_rate = -(points[end].p_N.z() - points[from].p_N.z()) / (t1 - t0);
        piece.p_N.z() = points[from].p_N.z() - piece.climb_rate * (time - t0);
        piece.duration = std::min(t1, e.start + e.duration) - time;
      }
      over.push_back(piece);
      time += piece.duration;
    }
  }
  return over;
}

}  // namespace skein::reasoning
