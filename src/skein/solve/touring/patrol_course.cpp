// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/touring/patrol_course.h"

#include <algorithm>
#include <cmath>

#include "skein/model/path/flight_plan.h"
#include "skein/model/path/wind_triangle.h"
#include "skein/solve/path/join.h"

namespace skein::solve {
namespace {

constexpr int kTries = 48;  // distances from a corner at which its turn may begin

Vec2 along_of(const PatrolLeg& leg) {
  return (leg.b - leg.a).normalized();
}

model::Pose pose_at(const PatrolLeg& leg, const Vec2& p, const model::AirMotion& air) {
  const double course = geo::bearing(leg.b - leg.a);
  return {p, model::heading_for_course(course, air.airspeed, air.wind).value_or(course)};
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 leg = b - a;
  const double s =
      std::clamp(leg.dot(p - a) / std::max(leg.squaredNorm(), 1e-12), 0.0, 1.0);
  return (p - a - s * leg).norm();
}

// Legs of an open or closed line, moved to the right; neighbours meet where the moved
// lines cross, unless the corner is so sharp, or a leg so short, that this is far off.
std::vector<PatrolLeg> moved(const std::vector<Vec2>& line, bool closed, double offset) {
  const std::size_t n = line.size(), count = closed ? n : n - 1;
  std::vector<PatrolLeg> plain;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2& p = line[k];
    const Vec2& q = line[(k + 1) % n];
    const Vec2 right = offset * geo::turned_right((q - p).normalized());
    plain.push_back({p + right, q + right});
  }
  std::vector<PatrolLeg> legs = plain;
  for (std::size_t k = 0; k + (closed ? 0 : 1) < count; ++k) {
    const std::size_t next = (k + 1) % count;
    const Vec2 u = along_of(plain[k]), v = along_of(plain[next]);
    if (u.dot(v) < -0.7) continue;
    const Vec2 corner =
        line[(k + 1) % n] +
        offset * (geo::turned_right(u) + geo::turned_right(v)) / (1 + u.dot(v));
    legs[k].b = legs[next].a = corner;
  }
  for (std::size_t k = 0; k < count; ++k)
    if ((legs[k].b - legs[k].a).dot(along_of(plain[k])) <= 0) return plain;
  return legs;
}

struct Corner {
  double d = 0;  // the turn begins and ends this far from the corner [m]
  model::Connection turn;
  double deviation = 0;
};

// Largest distance between line and flight at a corner between two legs.
double deviation_of(const PatrolLeg& in, const PatrolLeg& out, const Corner& corner,
                    const model::AirMotion& air) {
  const Vec2 u = along_of(in), v = along_of(out);
  const Vec2 begin = in.b - corner.d * u, end = out.a + corner.d * v;
  const FlightPlan plan =
      model::to_flight_plan(corner.turn, pose_at(in, begin, air), air);
  constexpr int kSamples = 16;
  const auto off = [&](const FlightElement& e, double t) {
    const Vec2 p = geo::horizontal(model::position(e, t));
    return std::min(distance(p, begin, in.b), distance(p, out.a, end));
  };
  double far = 0, from_corner = corner.d, at = 0;
  const FlightElement* farthest = nullptr;
  Vec2 before = begin;
  for (const FlightElement& e : plan)
    for (int k = 1; k <= kSamples; ++k) {
      const double t = e.duration * k / kSamples;
      const Vec2 p = geo::horizontal(model::position(e, t));
      from_corner = std::min(from_corner, distance(in.b, before, p));
      before = p;
      if (off(e, t) <= far) continue;
      far = off(e, t);
      farthest = &e;
      at = t;
    }
  // Where the nearer leg changes the distance has a peak between samples.
  if (farthest != nullptr)
    for (double step = farthest->duration / kSamples / 2; step > 1e-3; step /= 2)
      for (const double t : {at - step, at + step})
        if (t >= 0 && t <= farthest->duration && off(*farthest, t) > far) {
          far = off(*farthest, t);
          at = t;
        }
  return std::max(far, from_corner);
}

// The rounding that saves most time within the tolerance; d = 0 flies over the corner.
Corner rounded(const PatrolLeg& in, const PatrolLeg& out, const PatrolQuery& query,
               const model::AirMotion& air) {
  const auto at = [&](double d) {
    Corner c;
    c.d = d;
    c.turn = model::connect(pose_at(in, in.b - d * along_of(in), air),
                            pose_at(out, out.a + d * along_of(out), air), air);
    return c;
  };
  Corner found = at(0);
  if (query.corners == PatrolCorners::kFlownOver || (in.b - out.a).norm() > 1e-6)
    return found;
  const auto slowness = [&](const PatrolLeg& leg) {
    return straight(leg.a, leg.b, 0, air, 0).duration / (leg.b - leg.a).norm();
  };
  const double turn =
      model::ground_turn_radius(air.turn_radius, air.airspeed, air.wind.norm());
  const double room = std::min((in.b - in.a).norm(), (out.b - out.a).norm()) / 2;
  const double max = std::min(room, 3 * (turn + query.tolerance));
  const double saved = slowness(in) + slowness(out);
  double min = 1e300;
  for (int k = 1; k <= kTries; ++k) {
    Corner c = at(max * k / kTries);
    const double time = c.turn.time - c.d * saved;
    if (time >= min) continue;
    c.deviation = deviation_of(in, out, c, air);
    if (c.deviation > query.tolerance) continue;
    min = time;
    found = c;
  }
  // A rounding is worth it even where flying over would be quicker: it has no loop.
  return found;
}

}  // namespace

PatrolCourse course_of(const PatrolQuery& query, const std::vector<Vec2>& line,
                       double offset, const model::AirMotion& air) {
  PatrolCourse course;
  course.legs = moved(line, query.closed, offset);
  course.legs_of_pass = static_cast<int>(course.legs.size());
  if (!query.closed)
    for (std::size_t k = course.legs.size(); k-- > 0;)
      course.legs.push_back({course.legs[k].b, course.legs[k].a});
  const std::size_t n = course.legs.size();
  course.turns.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    PatrolLeg& in = course.legs[k];
    PatrolLeg& out = course.legs[(k + 1) % n];
    const bool turns_back =
        !query.closed && (k + 1) % static_cast<std::size_t>(course.legs_of_pass) == 0;
    PatrolQuery rule = query;
    if (turns_back) rule.corners = PatrolCorners::kFlownOver;
    const Corner corner = rounded(in, out, rule, air);
    course.turns[k] = corner.turn;
    in.early = corner.d;
    out.late = corner.d;
    course.deviation = std::max(course.deviation, corner.deviation);
    if (corner.d == 0 && !turns_back && query.corners == PatrolCorners::kRounded)
      ++course.flown_over;
  }
  return course;
}

model::Pose begin_of(const PatrolCourse& course, const model::AirMotion& air) {
  const PatrolLeg& first = course.legs.front();
  return pose_at(first, first.a + first.late * along_of(first), air);
}

FlightPlan along(const PatrolCourse& course, int passes, const model::AirMotion& air,
                 double start, double down) {
  FlightPlan plan;
  const std::size_t n = course.legs.size();
  const std::size_t legs =
      static_cast<std::size_t>(passes) * static_cast<std::size_t>(course.legs_of_pass);
  double now = start;
  const auto add = [&](const FlightElement& e) {
    if (e.duration <= 0) return;
    plan.push_back(e);
    now = e.start + e.duration;
  };
  for (std::size_t k = 0; k < legs; ++k) {
    const PatrolLeg& leg = course.legs[k % n];
    const Vec2 u = along_of(leg);
    const Vec2 end = leg.b - leg.early * u;
    add(straight(leg.a + leg.late * u, end, down, air, now));
    const bool last = k + 1 == legs;
    // Around, the last corner closes the round.
    if (last && course.legs_of_pass != static_cast<int>(n)) break;
    for (const FlightElement& e : model::to_flight_plan(
             course.turns[k % n], pose_at(leg, end, air), air, now, down))
      add(e);
  }
  return plan;
}

}  // namespace skein::solve
