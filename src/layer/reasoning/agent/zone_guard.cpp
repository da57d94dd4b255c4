#include "layer/reasoning/agent/zone_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/path/wind_triangle.h"

namespace skein::reasoning {
namespace {

constexpr double kStep = 0.25;           // of the preview [s]
constexpr int kCourses = 36;             // that are tried around the compass
constexpr double kHeadingGain = 1.2;     // of autopilots: rad/s per rad of error
constexpr double kRadiusReserve = 1.15;  // of the escape circle: room to correct
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

ZoneGuard::ZoneGuard(const ZoneGuardOptions& options, const FlightLimits& limits,
                     std::span<const Zone> zones)
    : options_(options), limits_(limits) {
  for (const Zone& zone : zones) zones_.emplace_back(geo::Region{outline(zone)});
}

double ZoneGuard::distance(const Vec2& p) const {
  double nearest = kInfinity;
  for (const geo::BoundaryIndex& zone : zones_)
    nearest = std::min(nearest, zone.signed_distance(p));
  return nearest;
}

// The state after the preview when turning to `course` now; `nearest` becomes the
// smallest distance to a zone on the way.
ZoneGuard::State ZoneGuard::fly(const NavEstimate& nav, double course,
                                double& nearest) const {
  const double airspeed = limits_.airspeed;
  const double fastest = airspeed / limits_.turn_radius;
  const double wanted =
      model::heading_for_course(course, airspeed, nav.wind_N).value_or(course);
  Vec2 p = geo::horizontal(nav.p_N);
  double heading = nav.heading;
  Vec2 v = geo::horizontal(nav.v_N);
  for (double t = 0; t < options_.preview - kStep / 2; t += kStep) {
    const double rate =
        std::clamp(kHeadingGain * geo::wrap_pi(wanted - heading), -fastest, fastest);
    v = airspeed * geo::unit(heading + rate * kStep / 2) + nav.wind_N;
    heading += rate * kStep;
    p += kStep * v;
    nearest = std::min(nearest, distance(p));
  }
  return {p, geo::bearing(airspeed * geo::unit(heading) + nav.wind_N)};
}

ZoneGuard::Escape ZoneGuard::best_escape(const State& state) const {
  Escape best;
  best.clearance = -kInfinity;
  for (const bool clockwise : {true, false}) {
    const double side = clockwise ? 1 : -1;
    const Vec2 centre =
        state.position + side * radius_ * geo::turned_right(geo::unit(state.course));
    const double clearance = distance(centre) - radius_ - options_.margin;
    if (clearance > best.clearance) best = {{centre, radius_, clockwise}, clearance};
  }
  return best;
}

double ZoneGuard::slack(const NavEstimate& nav, double course) const {
  double nearest = kInfinity;
  const State end = fly(nav, course, nearest);
  return std::min(nearest - options_.margin, best_escape(end).clearance);
}

Vec2 ZoneGuard::nearest_border(const Vec2& p) const {
  geo::NearestPoint best{p, kInfinity, 0, 0, 0};
  for (const geo::BoundaryIndex& zone : zones_) {
    const geo::NearestPoint here = zone.nearest(p);
    if (zone.contains(p) && here.distance < best.distance) best = here;
  }
  return best.point;
}

decltype(AutopilotCommand::guidance) ZoneGuard::check(
    const decltype(AutopilotCommand::guidance)& wanted, double course,
    const NavEstimate& nav) {
  deflecting_ = false;
  if (empty()) return wanted;
  const Vec2 position = geo::horizontal(nav.p_N);
  radius_ =
      kRadiusReserve *
      model::ground_turn_radius(limits_.turn_radius, limits_.airspeed, nav.wind_N.norm());
  const double here = distance(position);
  deflecting_ = here < 0;
  if (deflecting_) return HoldCourse{geo::bearing(nearest_border(position) - position)};
  const double reach = options_.preview * (limits_.airspeed + nav.wind_N.norm());
  const bool far = here > reach + 2 * radius_ + options_.margin;
  if (far || slack(nav, course) >= 0) {
    side_ = 0;
    return wanted;
  }

  deflecting_ = true;
  double best_slack = -kInfinity, best_course = course;
  for (int k = 1; k < kCourses; ++k) {
    // The chosen side first all the way round; before the choice, both sides in turn.
    const int side = side_ != 0 ? side_ : (k % 2 == 1 ? 1 : -1);
    const int steps = side_ != 0 ? k : (k + 1) / 2;
    const double tried = geo::wrap_pi(course + side * steps * 2 * geo::kPi / kCourses);
    const double value = slack(nav, tried);
    if (value >= 0) {
      side_ = side;
      return HoldCourse{tried};
    }
    if (value > best_slack) best_slack = value, best_course = tried;
  }
  // No course keeps the circle open after the preview: fly the one that is open now.
  const Escape escape = best_escape({position, geo::bearing(geo::horizontal(nav.v_N))});
  if (escape.clearance >= best_slack) return escape.circle;
  return HoldCourse{best_course};
}

}  // namespace skein::reasoning
