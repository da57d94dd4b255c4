// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/zone_avoidance.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"
#include "skein/geo/clip.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::reasoning {
namespace {

constexpr double kStep = 0.25;           // of the preview [s]
constexpr int kCourses = 36;             // that are tried around the compass
constexpr double kHeadingGain = 1.2;     // of autopilots: rad/s per rad of error
constexpr double kRadiusReserve = 1.15;  // of the escape circle: room to correct
constexpr double kBesideCircle = 0.1;    // of the radius, outside: still on the circle
constexpr double kAlongCircle = 0.9;     // cosine of the course to its tangent
constexpr double kRollTime = 0.8;        // from wings level to the steepest bank [s]

}  // namespace

ZoneAvoidance::ZoneAvoidance(const ZoneAvoidanceOptions& options,
                             const FlightLimits& limits, std::span<const Zone> zones)
    : options_(options), limits_(limits), border_(geo::Region{}) {
  set_zones(zones);
}

void ZoneAvoidance::set_zones(std::span<const Zone> zones) {
  zones_.assign(zones.begin(), zones.end());
  counts_.assign(zones_.size(), true);
  draw_border();
}

void ZoneAvoidance::draw_border() {
  geo::Region rings;
  for (const Zone& zone : counting()) rings.push_back(outline(zone));
  border_ = geo::BoundaryIndex(geo::clean_touching(rings, geo::FillRule::kNonZero));
}

bool ZoneAvoidance::regard(const NavEstimate& nav, std::optional<double> altitude_msl) {
  const double here = -nav.p_N.z(), there = altitude_msl.value_or(here);
  const double low = std::min(here, there) - options_.vertical_margin;
  const double high = std::max(here, there) + options_.vertical_margin;
  const double now = nav.time.seconds();
  bool changed = false;
  for (std::size_t k = 0; k < zones_.size(); ++k) {
    const bool counts = concerns(zones_[k], low, high, now, now + options_.lead);
    changed = changed || counts != counts_[k];
    counts_[k] = counts;
  }
  if (changed) draw_border();
  return changed;
}

std::vector<Zone> ZoneAvoidance::counting() const {
  std::vector<Zone> all;
  for (std::size_t k = 0; k < zones_.size(); ++k)
    if (counts_[k]) all.push_back(zones_[k]);
  return all;
}

double ZoneAvoidance::circle_radius(const NavEstimate& nav) const {
  return kRadiusReserve * model::ground_turn_radius(limits_.turn_radius, limits_.airspeed,
                                                    nav.wind_N.norm());
}

double ZoneAvoidance::distance(const Vec2& p) const {
  return border_.empty() ? math::kInfinity : border_.signed_distance(p);
}

// In its present bank; what hovers needs none.
double ZoneAvoidance::turn_rate(const NavEstimate& nav) const {
  if (limits_.slowest <= 0) return 0;
  const double fastest = limits_.airspeed / limits_.turn_radius;
  return std::clamp(
      kGravity * math::tan(std::clamp(nav.roll, -1.3, 1.3)) / limits_.airspeed, -fastest,
      fastest);
}

// The state after the preview when turning to `course` now; `nearest` becomes the
// smallest distance to a zone in between.
ZoneAvoidance::State ZoneAvoidance::fly(const NavEstimate& nav, double course,
                                        double& nearest) const {
  const double airspeed = limits_.airspeed;
  const double fastest = airspeed / limits_.turn_radius;
  const double setpoint =
      model::heading_for_course(course, airspeed, nav.wind_N).value_or(course);
  Vec2 p = geo::horizontal(nav.p_N);
  double heading = nav.heading;
  Vec2 v = geo::horizontal(nav.v_N);
  double rate = turn_rate(nav);
  const double change =
      limits_.slowest > 0 ? fastest / kRollTime * kStep : 2 * fastest;  // in a step
  for (double t = 0; t < options_.preview - kStep / 2; t += kStep) {
    const double demanded =
        std::clamp(kHeadingGain * geo::wrap_pi(setpoint - heading), -fastest, fastest);
    rate += std::clamp(demanded - rate, -change, change);
    v = airspeed * geo::unit(heading + rate * kStep / 2) + nav.wind_N;
    heading += rate * kStep;
    p += kStep * v;
    nearest = std::min(nearest, distance(p));
  }
  return {p, airspeed * geo::unit(heading) + nav.wind_N, rate};
}

ZoneAvoidance::Escape ZoneAvoidance::best_escape(const State& state) const {
  Escape best;
  best.clearance = -math::kInfinity;
  const double fastest = limits_.airspeed / limits_.turn_radius;
  for (const bool clockwise : {true, false}) {
    const double side = clockwise ? 1 : -1;
    // Until it has banked it turns less: by as much as on a straight of that time.
    const double lacking = 1 - side * state.turn_rate / fastest;
    const double late = limits_.slowest > 0 ? lacking * lacking * kRollTime / 2 : 0;
    const Vec2 centre = state.position + late * state.velocity +
                        side * radius_ * geo::turned_right(state.velocity.normalized());
    const double clearance = distance(centre) - radius_ - options_.margin;
    if (clearance > best.clearance) best = {{centre, radius_, clockwise}, clearance};
  }
  return best;
}

double ZoneAvoidance::slack(const NavEstimate& nav, double course) const {
  double nearest = math::kInfinity;
  const State end = fly(nav, course, nearest);
  return std::min(nearest - options_.margin, best_escape(end).clearance);
}

// Whether it is on a circle that keeps the margin, or within and about to be.
bool ZoneAvoidance::stays_on(const Circle& circle, const NavEstimate& nav) const {
  if (circle.radius < radius_ / kRadiusReserve ||
      distance(circle.centre) < circle.radius + options_.margin)
    return false;
  const Vec2 out = geo::horizontal(nav.p_N) - circle.centre;
  const Vec2 round = (circle.clockwise ? 1 : -1) * geo::turned_right(out);
  const Vec2 v = geo::horizontal(nav.v_N);
  const double slack = std::min(kBesideCircle * circle.radius, options_.margin / 3);
  return out.norm() < circle.radius + slack &&
         round.dot(v) > kAlongCircle * out.norm() * v.norm();
}

decltype(AutopilotCommand::guidance) ZoneAvoidance::check(
    const decltype(AutopilotCommand::guidance)& setpoint, double course,
    const NavEstimate& nav, std::optional<double> altitude_msl) {
  deflecting_ = false;
  if (empty()) return setpoint;
  regard(nav, altitude_msl);
  if (border_.empty()) {
    side_ = 0;
    return setpoint;
  }
  const Vec2 position = geo::horizontal(nav.p_N);
  radius_ = circle_radius(nav);
  const double here = distance(position);
  deflecting_ = here < 0;
  if (deflecting_)
    return HoldCourse{geo::bearing(border_.nearest(position).point - position)};
  if (const auto* circle = std::get_if<Circle>(&setpoint);
      circle && stays_on(*circle, nav)) {
    side_ = 0;
    return setpoint;
  }
  const double reach = options_.preview * (limits_.airspeed + nav.wind_N.norm());
  const bool far = here > reach + 2 * radius_ + options_.margin;
  if (far || slack(nav, course) >= 0) {
    side_ = 0;
    return setpoint;
  }

  deflecting_ = true;
  double best_slack = -math::kInfinity, best_course = course;
  for (int k = 1; k < kCourses; ++k) {
    // The chosen side first, a full circle; before the choice, both sides in turn.
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
  const Escape escape = best_escape({position, geo::horizontal(nav.v_N), turn_rate(nav)});
  if (escape.clearance >= best_slack) return escape.circle;
  return HoldCourse{best_course};
}

}  // namespace skein::reasoning
