// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/unflyable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/atmosphere/atmosphere.h"
#include "skein/model/path/plan_curve.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::autopilot {
namespace {

using Reason = std::optional<std::string>;

constexpr double kSpeedSlack = 0.03;
constexpr double kClimbSlack = 0.1;
constexpr double kTurnSlack = 0.01;
constexpr double kWindow = 1;  // of a plan, whose turns and climbs count as one [s]
constexpr double kDensitySlack = 1e-6;
constexpr int kInstants = 16;       // of a plan's segment or of a turn
constexpr double kOnePoint = 1e-3;  // waypoints nearer than this are one [m]

bool finite(const Vec2& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y());
}
bool finite(const Vec3& v) {
  return v.allFinite();
}

struct Judge {
  const FlightLimits& limits;
  const Vec2& wind;
  double usual_airspeed;  // where the guidance has none of its own [m/s]

  bool hovers() const { return limits.slowest <= 0; }
  double max_lateral() const {
    return limits.airspeed * limits.airspeed / limits.turn_radius;
  }

  // Speed over ground along `course` at an airspeed; 0 when the wind does not let it.
  double ground_speed(const Vec2& course, double airspeed) const {
    const double across = geo::cross(course, wind);
    const double level2 = airspeed * airspeed - across * across;
    return level2 <= 0 ? 0 : std::max(std::sqrt(level2) + wind.dot(course), 0.0);
  }

  // `what` gives the subject's words: put together only when there is something to say.
  template <class What>
  Reason course(const Vec2& course, const What& what) const {
    if (ground_speed(course, limits.fastest) > 0) return {};
    return fmt::format(
        "{} at {:.0f} deg cannot be made good in {:.1f} m/s of wind at {:.1f} m/s at "
        "most",
        what(), geo::degrees(geo::wrap_2pi(geo::bearing(course))), wind.norm(),
        limits.fastest);
  }

  // Lateral acceleration that the bank must give, per curvature, on this course at the
  // slowest airspeed that makes it good.
  double needed_per_curvature(const Vec2& course) const {
    const double across = geo::cross(course, wind);
    double airspeed = limits.slowest;
    double speed = ground_speed(course, airspeed);
    if (speed == 0) {
      airspeed = limits.fastest;
      speed = ground_speed(course, airspeed);
    }
    const double cosine =
        std::sqrt(std::max(1 - across * across / (airspeed * airspeed), 1e-6));
    return speed * speed / cosine;
  }

  // A turn from a course by an angle (right positive) at a radius.
  template <class What>
  Reason turn(double from, double angle, double radius, const What& what) const {
    if (hovers()) return {};
    if (!(radius > 0)) return fmt::format("{} has no radius", what());
    double max = 0;
    const double downwind = geo::bearing(wind);
    // The need is largest downwind, if the turn comes there; else near one of its ends.
    const double to_downwind =
        angle >= 0 ? geo::wrap_2pi(downwind - from) : geo::wrap_2pi(from - downwind);
    if (to_downwind <= std::abs(angle)) max = needed_per_curvature(geo::unit(downwind));
    for (int i = 0; i <= kInstants; ++i)
      max = std::max(max, needed_per_curvature(geo::unit(from + angle * i / kInstants)));
    const double min = max / max_lateral();
    if (radius >= min * (1 - kTurnSlack)) return {};
    return fmt::format(
        "{} has a radius of {:.0f} m: {:.0f} m is the minimum at {:.1f} m/s in {:.1f} "
        "m/s of wind",
        what(), radius, std::ceil(min), limits.slowest, wind.norm());
  }

  template <class What>
  Reason climb(double rate, const What& what) const {
    if (rate > limits.climb_rate * (1 + kClimbSlack))
      return fmt::format("{} climbs at {:.1f} m/s: {:.1f} m/s is the maximum", what(),
                         rate, limits.climb_rate);
    if (-rate > limits.sink_rate * (1 + kClimbSlack))
      return fmt::format("{} sinks at {:.1f} m/s: {:.1f} m/s is the maximum", what(),
                         -rate, limits.sink_rate);
    return {};
  }

  // Whether the air at an altitude carries it at an airspeed.
  template <class What>
  Reason carried(double altitude_msl, double at, const What& what) const {
    if (limits.min_density <= 0) return {};
    const double density = model::standard_air(altitude_msl).density;
    if (density < limits.min_density * (1 - kDensitySlack))
      return fmt::format(
          "{} is {:.0f} m, where the air is too thin to fly level at any airspeed: "
          "{:.0f} "
          "m is the maximum",
          what(), altitude_msl, std::floor(model::standard_altitude(limits.min_density)));
    const double slowest = limits.slowest * std::sqrt(model::kSeaLevelDensity / density);
    if (at >= slowest * (1 - kSpeedSlack)) return {};
    return fmt::format(
        "{} is {:.0f} m, where the thin air carries from {:.1f} m/s on: the airspeed is "
        "{:.1f} m/s",
        what(), altitude_msl, slowest, at);
  }

  Reason judge(const FollowPath& f) const {
    for (std::size_t i = 0; i < f.path.size(); ++i) {
      const PathElement& e = f.path[i];
      const auto what = [i] { return fmt::format("element {} of the path", i + 1); };
      if (!finite(e.start) ||
          !std::isfinite(e.course + e.length + e.curvature + e.length * e.curvature))
        return what() + " is not finite";
      if (e.length < 0) return what() + " has a negative length";
      if (hovers()) continue;
      if (e.curvature != 0) {
        const double turned = std::clamp(e.curvature * e.length, -7.0, 7.0);
        if (auto r = turn(e.course, turned, 1 / std::abs(e.curvature), what)) return r;
      } else if (auto r = course(geo::unit(e.course), what)) {
        return r;
      }
    }
    return {};
  }

  Reason judge(const HoldCourse& h) const {
    if (!std::isfinite(h.course)) return "the course is not finite";
    return course(geo::unit(h.course), [] { return "the course"; });
  }

  Reason judge(const HoldBank& h) const {
    if (!std::isfinite(h.roll)) return "the bank is not finite";
    if (hovers()) return "what hovers does not bank to turn";
    return {};
  }

  Reason judge(const Circle& c) const {
    if (!finite(c.centre) || !std::isfinite(c.radius)) return "the circle is not finite";
    if (c.radius <= 0) return "the circle has no radius";
    return turn(0, 2 * geo::kPi, c.radius, [] { return "the circle"; });
  }

  Reason judge(const HoldPosition& h) const {
    if (!finite(h.point)) return "the point is not finite";
    return {};
  }

  Reason judge(const FollowPlan& f) const {
    if (f.plan.empty()) return "the plan is empty";
    for (std::size_t i = 0; i < f.plan.size(); ++i) {
      if (!finite(f.plan[i].p_N) || !finite(f.plan[i].v_N))
        return fmt::format("point {} of the plan is not finite", i + 1);
      if (i > 0 && f.plan[i].time <= f.plan[i - 1].time)
        return fmt::format("point {} of the plan is not later than the one before",
                           i + 1);
    }
    model::PlanCurve curve;
    curve.assign(f.plan);
    for (std::size_t i = 0; i + 1 < f.plan.size(); ++i) {
      const double begin = f.plan[i].time.seconds();
      const double span = f.plan[i + 1].time.seconds() - begin;
      for (int k = 0; k <= kInstants; ++k) {
        const double time = begin + span * k / kInstants;
        if (auto r = judge(curve.at(time), curve, time)) return r;
      }
    }
    return {};
  }

  // Of the track, with which it turns around a time: within a second nobody banks and
  // levels out again, so what a plan asks for in less is cut as on any corner.
  static double mean_turn_rate(const model::PlanCurve& curve, double time) {
    const double begin = std::max(time - kWindow / 2, curve.start());
    const double end = std::min(time + kWindow / 2, curve.end());
    const Vec2 before = curve.at(begin).v_N.head<2>(),
               after = curve.at(end).v_N.head<2>();
    const double turned = math::atan2(geo::cross(before, after), before.dot(after));
    return std::abs(turned) / std::max(end - begin, kWindow / 2);
  }

  // The same of its climb: points that are milliseconds apart are rounded.
  static double mean_climb_rate(const model::PlanCurve& curve, double time) {
    const double begin = std::max(time - kWindow / 2, curve.start());
    const double end = std::min(time + kWindow / 2, curve.end());
    return (curve.at(begin).p_N.z() - curve.at(end).p_N.z()) /
           std::max(end - begin, kWindow / 2);
  }

  Reason judge(const model::PlanCurve::State& at, const model::PlanCurve& curve,
               double time) const {
    const Vec2 v = at.v_N.head<2>();
    const Vec2 air = v - wind;
    const double airspeed = std::sqrt(air.squaredNorm() + at.v_N.z() * at.v_N.z());
    if (!std::isfinite(airspeed) || !finite(at.a_N))
      return fmt::format("the plan at {:.1f} s is not finite", time);
    if (airspeed > limits.fastest * (1 + kSpeedSlack) ||
        airspeed < limits.slowest * (1 - kSpeedSlack))
      return fmt::format(
          "the plan at {:.1f} s needs an airspeed of {:.1f} m/s in {:.1f} m/s of wind: "
          "from {:.1f} to {:.1f} m/s can be flown",
          time, airspeed, wind.norm(), limits.slowest, limits.fastest);
    if (auto r = carried(-at.p_N.z(), airspeed, [time] {
          return fmt::format("the altitude of the plan at {:.1f} s", time);
        }))
      return r;
    const double mean = mean_climb_rate(curve, time);
    if (auto r = climb(std::abs(mean) < std::abs(at.v_N.z()) ? mean : -at.v_N.z(),
                       [time] { return fmt::format("the plan at {:.1f} s", time); }))
      return r;
    const double speed = v.norm();
    if (hovers() || speed < 1e-3) return {};
    const double lateral = std::abs(geo::cross(v, at.a_N.head<2>())) / speed;
    const double cosine = std::max(v.dot(air) / (speed * air.norm()), 1e-3);
    const double allowed = max_lateral() * cosine * (1 + kTurnSlack);
    if (lateral <= allowed || mean_turn_rate(curve, time) * speed <= allowed) return {};
    return fmt::format(
        "the plan at {:.1f} s turns with a radius of {:.0f} m at {:.1f} m/s over ground: "
        "{:.0f} m is the minimum",
        time, speed * speed / lateral, speed, speed * speed / (max_lateral() * cosine));
  }

  Reason judge(const FlyWaypoints& w) const {
    if (w.points.empty()) return "there are no waypoints";
    if (w.laps < 1) return fmt::format("{} laps cannot be flown", w.laps);
    for (std::size_t i = 0; i < w.points.size(); ++i)
      if (!finite(w.points[i].point) || !std::isfinite(w.points[i].altitude_msl))
        return fmt::format("waypoint {} is not finite", i + 1);
    for (std::size_t i = 0; i < w.points.size(); ++i)
      if (auto r = carried(w.points[i].altitude_msl, usual_airspeed, [i] {
            return fmt::format("the altitude of waypoint {}", i + 1);
          }))
        return r;
    // The leg back to the first counts when there is another lap.
    const std::size_t n = w.points.size();
    const std::size_t legs = w.laps > 1 ? n : n - 1;
    for (std::size_t i = 0; i < legs; ++i) {
      if (auto r = leg(w.points[i], w.points[(i + 1) % n], [i, n] {
            return fmt::format("the leg to waypoint {}", (i + 1) % n + 1);
          }))
        return r;
    }
    return {};
  }

  template <class What>
  Reason leg(const FlyWaypoints::Waypoint& a, const FlyWaypoints::Waypoint& b,
             const What& what) const {
    const Vec2 leg = b.point - a.point;
    const double length = leg.norm(), rise = b.altitude_msl - a.altitude_msl;
    if (length < kOnePoint) {
      if (std::abs(rise) < kOnePoint) return {};
      return what() + " leads straight up or down";
    }
    if (hovers()) return {};
    if (auto r = course(leg / length, what)) return r;
    double speed = ground_speed(leg / length, limits.slowest);
    if (speed == 0) speed = ground_speed(leg / length, limits.fastest);
    return climb(rise / length * speed, what);
  }

  Reason judge(const TakeOff& t) const {
    if (!std::isfinite(t.course)) return "the take-off's course is not finite";
    return {};
  }

  Reason judge(const Land& l) const {
    if (!finite(l.point) || !std::isfinite(l.ground_msl) ||
        (l.course && !std::isfinite(*l.course)))
      return "the landing is not finite";
    if (!l.course || hovers()) return {};
    return course(geo::unit(*l.course), [] { return "the approach"; });
  }

  Reason judge(const Return& order) const {
    if (order.point && !finite(*order.point)) return "the point is not finite";
    return {};
  }
};

// Whether the numbers of a guidance are finite.
struct Numbers {
  bool operator()(const HoldCourse& h) { return std::isfinite(h.course); }
  bool operator()(const HoldBank& h) { return std::isfinite(h.roll); }
  bool operator()(const HoldPosition& h) { return finite(h.point); }
  bool operator()(const Circle& c) { return finite(c.centre) && std::isfinite(c.radius); }
  bool operator()(const FollowPath& f) {
    return std::all_of(f.path.begin(), f.path.end(), [](const PathElement& e) {
      return finite(e.start) && std::isfinite(e.course + e.length + e.curvature);
    });
  }
  bool operator()(const auto&) { return true; }
};

}  // namespace

std::optional<std::string> not_finite(const AutopilotCommand& command) {
  if (!std::isfinite(command.altitude_msl) ||
      !std::isfinite(command.airspeed.value_or(0)))
    return "altitude or airspeed is not finite";
  if (!std::visit(Numbers(), command.guidance)) return "the guidance is not finite";
  return {};
}

std::optional<std::string> unflyable(const AutopilotCommand& command,
                                     const FlightLimits& limits, const Vec2& wind) {
  if (!std::isfinite(command.altitude_msl)) return "the altitude is not finite";
  if (command.airspeed) {
    const double v = *command.airspeed;
    if (!(v >= limits.slowest * (1 - kSpeedSlack) &&
          v <= limits.fastest * (1 + kSpeedSlack)))
      return fmt::format(
          "an airspeed of {:.1f} m/s: from {:.1f} to {:.1f} m/s can be flown", v,
          limits.slowest, limits.fastest);
  }
  const Judge judge{limits, wind, command.airspeed.value_or(limits.airspeed)};
  if (auto reason = judge.carried(command.altitude_msl, judge.usual_airspeed,
                                  [] { return "the commanded altitude"; }))
    return reason;
  return std::visit([&](const auto& guidance) { return judge.judge(guidance); },
                    command.guidance);
}

}  // namespace skein::autopilot
