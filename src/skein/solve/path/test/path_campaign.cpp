// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/test/path_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "skein/solve/path/aa_star.h"
#include "skein/solve/path/lower_bound.h"
#include "skein/solve/path/test/independent_flights.h"
#include "skein/solve/path/test/independent_paths.h"
#include "skein/solve/path/test/oracle.h"

namespace skein::solve::test {
namespace {

using independent::Real;

// What two computations of the same time may differ by, relative.
constexpr Real kRounding = 1e-9L;
// How deep a path may be in a zone [m].
constexpr double kDeepest = 0.08;
// How far routes stay from circles [m].
constexpr double kBeside = 0.02;
// Kinds of problems, and for how many of each one search over a lattice is made, which is
// slow.
constexpr std::uint32_t kKinds = 8, kLattice = 3, kLatticeEvery = 15;

class Draw {
 public:
  explicit Draw(std::uint32_t number) : engine_(number * 2654435761U + 17) {}
  double within(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int whole(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double p) { return within(0, 1) < p; }

 private:
  std::mt19937_64 engine_;
};

struct Problem {
  Airspace airspace;
  PathQuery query;
};

Vec2 wind_up_to(Draw& draw, double ratio, double airspeed) {
  return draw.within(0, ratio) * airspeed * geo::unit(draw.within(-geo::kPi, geo::kPi));
}

// Around a middle with growing bearing: clockwise, and never crossing itself.
geo::Ring star(Draw& draw, const Vec2& middle, double size) {
  geo::Ring ring;
  const int corners = draw.whole(3, 7);
  for (int i = 0; i < corners; ++i) {
    const double bearing = 2 * geo::kPi * (i + draw.within(-0.3, 0.3)) / corners;
    ring.push_back(middle + draw.within(0.3, 1) * size * geo::unit(bearing));
  }
  return ring;
}

void ends(Draw& draw, double distance, PathQuery& q) {
  q.start = {Vec3(0, 0, -100), draw.within(-geo::kPi, geo::kPi)};
  q.goal = {Vec3(distance, 0, -100), draw.within(-geo::kPi, geo::kPi)};
  q.limits.airspeed = draw.within(10, 30);
  q.limits.turn_radius = 60;
}

Problem circles(Draw& draw, bool wind) {
  Problem p;
  ends(draw, draw.within(600, 2500), p.query);
  const int count = draw.whole(1, 8);
  for (int i = 0; i < count; ++i)
    p.airspace.zones.push_back(
        {Disc{Vec2(draw.within(0, p.query.goal.p_N.x()), draw.within(-400, 400)),
              wind ? draw.within(5, 300) : draw.within(60, 200)}});
  if (wind)
    p.query.wind =
        wind_up_to(draw, draw.chance(0.1) ? 0.999 : 0.95, p.query.limits.airspeed);
  return p;
}

Problem polygons(Draw& draw) {
  Problem p;
  ends(draw, draw.within(600, 2500), p.query);
  const int count = draw.whole(1, 4);
  for (int i = 0; i < count; ++i)
    p.airspace.zones.push_back(
        {star(draw, Vec2(draw.within(0, p.query.goal.p_N.x()), draw.within(-300, 300)),
              draw.within(20, 400))});
  if (draw.chance(0.5)) p.airspace.zones.push_back({Disc{Vec2(500, 0), 150}});
  if (draw.chance(0.5)) p.query.wind = wind_up_to(draw, 0.9, p.query.limits.airspeed);
  return p;
}

// Circles and squares on a lattice: many touch each other, the start or the goal.
Problem lattice(Draw& draw) {
  Problem p;
  ends(draw, 100 * draw.whole(6, 16), p.query);
  const int count = draw.whole(1, 7);
  for (int i = 0; i < count; ++i) {
    const Vec2 at(100 * draw.whole(0, 16), 100 * draw.whole(-4, 4));
    const double size = 50 * draw.whole(1, 5);
    if (draw.chance(0.6))
      p.airspace.zones.push_back({Disc{at, size}});
    else
      p.airspace.zones.push_back(
          {geo::Ring{at + Vec2(size, size), at + Vec2(-size, size),
                     at + Vec2(-size, -size), at + Vec2(size, -size)}});
  }
  for (FlightState* s : {&p.query.start, &p.query.goal})
    s->heading = geo::kPi / 4 * draw.whole(-3, 4);
  if (draw.chance(0.4)) p.query.wind = wind_up_to(draw, 0.8, p.query.limits.airspeed);
  return p;
}

// The goal within a ring of circles that nearly touch, or overlap.
Problem ringed(Draw& draw) {
  Problem p;
  ends(draw, 1500, p.query);
  const int count = draw.whole(5, 9);
  const double ring = draw.within(250, 500), half = ring * std::sin(geo::kPi / count);
  const double first = draw.within(0, geo::kPi);
  for (int i = 0; i < count; ++i) {
    double gap = draw.chance(0.8) ? draw.within(-5, -0.2) : draw.within(-0.2, 0.5);
    if (draw.chance(0.05)) gap = draw.within(0.5, 100);
    p.airspace.zones.push_back(
        {Disc{Vec2(1500, 0) + ring * geo::unit(first + 2 * geo::kPi * i / count),
              half - gap / 2}});
  }
  if (draw.chance(0.3)) p.query.wind = wind_up_to(draw, 0.5, p.query.limits.airspeed);
  return p;
}

independent::Field field_of(const Airspace& airspace, double smaller = 0) {
  independent::Field field;
  for (const Zone& zone : airspace.zones) {
    if (std::isfinite(zone.floor_msl) || std::isfinite(zone.ceiling_msl)) continue;
    if (const auto* disc = std::get_if<Disc>(&zone.area)) {
      if (disc->radius > smaller)
        field.circles.push_back(
            {{disc->centre.x(), disc->centre.y()}, disc->radius - smaller});
      continue;
    }
    field.polygons.emplace_back();
    for (const Vec2& corner : std::get<geo::Ring>(zone.area))
      field.polygons.back().push_back({corner.x(), corner.y()});
  }
  return field;
}

// The same a little larger, so that what touches leaves no gap. A circle at whose rim an
// end lies stays as it is.
independent::Field closed(independent::Field field, const PathQuery& q) {
  constexpr Real kLarger = 1e-5L;
  for (auto& circle : field.circles) {
    const bool at_end =
        std::ranges::any_of(std::array{q.start.p_N, q.goal.p_N}, [&](const Vec3& p) {
          const Real far = std::hypot(circle.centre.x - p.x(), circle.centre.y - p.y());
          return far < circle.radius + 2 * kLarger;
        });
    if (!at_end) circle.radius += kLarger;
  }
  for (auto& polygon : field.polygons) {
    const std::vector<independent::Point> as_is = polygon;
    const std::size_t n = as_is.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto outwards = [&](std::size_t a, std::size_t b) {
        const independent::Point edge = as_is[b] - as_is[a];
        return -1 / length(edge) * right_of(edge);  // rings are clockwise
      };
      const independent::Point before = outwards((i + n - 1) % n, i);
      const independent::Point after = outwards(i, (i + 1) % n);
      polygon[i] = as_is[i] + kLarger / (1 + dot(before, after)) * (before + after);
    }
  }
  return field;
}

independent::Pose pose_of(const FlightState& s) {
  return {{s.p_N.x(), s.p_N.y()}, s.heading};
}

independent::Air air_of_query(const PathQuery& q) {
  return {q.limits.airspeed, {q.wind.x(), q.wind.y()}};
}

Real point_time_of(const PathQuery& q, const independent::Field& field) {
  return independent::point_time(field, air_of_query(q), pose_of(q.start).at,
                                 pose_of(q.goal).at);
}

// One polygon, moved aside until it takes as long to pass it on the left as on the right.
Problem tie(Draw& draw) {
  Problem p;
  ends(draw, draw.within(400, 2000), p.query);
  if (draw.chance(0.3)) p.query.wind = wind_up_to(draw, 0.9, p.query.limits.airspeed);
  const Vec2 middle(draw.within(0.3, 0.7) * p.query.goal.p_N.x(), 0);
  const geo::Ring ring = star(draw, middle, 0.25 * p.query.goal.p_N.x());
  const auto moved_by = [&](double aside) {
    geo::Ring moved = ring;
    for (Vec2& corner : moved) corner.y() += aside;
    return moved;
  };
  // Positive when the side to the right is quicker.
  const auto quicker_right = [&](double aside) {
    const auto past = [&](double side) {
      Airspace airspace;
      airspace.zones.push_back({moved_by(aside)});
      independent::Field field = field_of(airspace);
      const Real x = middle.x(), y = aside;
      field.polygons.push_back(
          {{x - 0.1L, y}, {x + 0.1L, y}, {x, y - Real(side) * 1e5L}});
      return point_time_of(p.query, field);
    };
    return past(-1) - past(1);
  };
  double low = -0.5 * p.query.goal.p_N.x(), high = -low;
  for (int i = 0; i < 40; ++i) {
    const double half = (low + high) / 2;
    (quicker_right(half) > 0 ? low : high) = half;
  }
  p.airspace.zones.push_back({moved_by(low + draw.within(-0.05, 0.05))});
  return p;
}

Problem near_goal(Draw& draw) {
  Problem p;
  ends(draw, draw.within(0, 700), p.query);
  p.query.wind = wind_up_to(draw, 0.95, p.query.limits.airspeed);
  if (draw.chance(0.5)) p.query.goal.p_N.z() -= draw.within(-200, 200);
  return p;
}

Problem climbs(Draw& draw) {
  Problem p = circles(draw, draw.chance(0.5));
  p.query.goal.p_N.z() -= draw.within(-150, 150);
  p.query.limits.climb_rate = draw.within(0.5, 4);
  p.query.limits.sink_rate = draw.within(0.5, 4);
  if (draw.chance(0.5)) p.query.limits.climb_acceleration = draw.within(0.1, 2);
  for (Zone& zone : p.airspace.zones) {
    if (draw.chance(0.3)) zone.ceiling_msl = draw.within(80, 200);
    if (draw.chance(0.2)) zone.floor_msl = draw.within(0, 80);
  }
  return p;
}

Problem drawn(std::uint32_t number) {
  Draw draw(number);
  switch (number % kKinds) {
    case 0:
      return circles(draw, false);
    case 1:
      return circles(draw, true);
    case 2:
      return polygons(draw);
    case kLattice:
      return lattice(draw);
    case 4:
      return ringed(draw);
    case 5:
      return tie(draw);
    case 6:
      return near_goal(draw);
    default:
      return climbs(draw);
  }
}

// h / c + c / a; 2 sqrt(h / a) where the rate c is not reached.
Real climb_time_of(const PathQuery& q) {
  const Real climb = q.start.p_N.z() - q.goal.p_N.z(), height = std::abs(climb);
  const Real rate = climb > 0 ? q.limits.climb_rate : q.limits.sink_rate;
  const Real change = q.limits.climb_acceleration;
  if (change == 0) return height / rate;
  return height * change < rate * rate ? 2 * std::sqrt(height / change)
                                       : height / rate + rate / change;
}

class Check {
 public:
  Check(std::uint32_t number, Problem problem)
      : number_(number), problem_(std::move(problem)), q_(problem_.query) {
    q_.airspace = &problem_.airspace;
    q_.budget.expansions = 3'000;
    tally_.problems = 1;
  }

  PathTally run() {
    field_ = field_of(problem_.airspace);
    if (number_ % kKinds == kLattice) field_ = closed(field_, q_);
    path_ = AaStar().plan(q_);
    const bool refused = path_.plan.empty() &&
                         path_.outcome != PlanningOutcome::kNoPath &&
                         path_.outcome != PlanningOutcome::kNothingFound;
    if (refused) return tally_;
    SearchBudget budget(q_.budget);
    const Real by_zones = lower_bound(q_, budget).time;
    point_ = point_time_of(q_, field_);
    if (const auto meeting = independent::earliest_meeting(
            air_of_query(q_), pose_of(q_.start), pose_of(q_.goal), q_.limits.turn_radius);
        meeting && meeting->regular)
      connection_ = meeting->time;
    judge_bound(by_zones);
    judge_parted(by_zones);
    if (!path_.plan.empty()) {
      ++tally_.paths;
      judge_path();
      judge_shortest();
    }
    if (number_ / kKinds % kLatticeEvery == 0 && q_.start.p_N.z() == q_.goal.p_N.z())
      compare_with_flight();
    return tally_;
  }

 private:
  void note(int& faults, const char* fault, Real claimed, Real known) {
    ++faults;
    if (tally_.first.empty())
      tally_.first = fmt::format(
          "path problem {}: {}: {:.12g}, but {:.12g} ({}, bound {:.12g}, duration "
          "{:.12g})",
          number_, fault, static_cast<double>(claimed), static_cast<double>(known),
          name_of(path_.outcome), path_.bound, path_.duration);
  }

  void judge_bound(Real by_zones) {
    tally_.bounds += path_.bound > 0 ? 1 : 0;
    const Real least = std::max({point_, connection_, climb_time_of(q_)});
    if (path_.bound > least * (1 + kRounding))
      note(tally_.false_bounds, "bound", path_.bound, least);
    else if (std::isfinite(by_zones) && by_zones > point_ * (1 + kRounding))
      note(tally_.false_bounds, "bound by zones", by_zones, point_);
  }

  void judge_parted(Real by_zones) {
    if (std::isfinite(by_zones)) return;
    ++tally_.parted;
    if (std::isfinite(point_)) note(tally_.false_parted, "parted", by_zones, point_);
  }

  void judge_path() {
    const double deep = depth(problem_.airspace, path_.plan, 0.02);
    if (deep > kDeepest + 1e-6) note(tally_.false_paths, "depth", kDeepest, deep);
    if (gaps(path_.plan) > 1e-6) note(tally_.false_paths, "gap", 0, gaps(path_.plan));
    if (!field_.polygons.empty()) return;  // corners may be cut by what is allowed
    const Real least = std::max({point_time_of(q_, field_of(problem_.airspace, kDeepest)),
                                 climb_time_of(q_), connection_});
    if (path_.duration < least * (1 - kRounding))
      note(tally_.false_paths, "quicker than can be", path_.duration, least);
  }

  // Still air, level, only circles that can be flown along, and no path by the bound.
  void judge_shortest() {
    const bool flyable = std::all_of(
        field_.circles.begin(), field_.circles.end(),
        [&](const auto& c) { return c.radius >= Real(q_.limits.turn_radius); });
    const bool of_kind = q_.wind.isZero() && flyable && field_.polygons.empty() &&
                         field_.circles.size() == problem_.airspace.zones.size() &&
                         q_.start.p_N.z() == q_.goal.p_N.z();
    if (!of_kind || path_.outcome != PlanningOutcome::kFound ||
        path_.duration <= path_.bound * 1.001)
      return;
    ++tally_.shortest;
    const Real length = independent::route_length(field_of(problem_.airspace, -kBeside),
                                                  pose_of(q_.start), pose_of(q_.goal),
                                                  q_.limits.turn_radius);
    const Real flown = Real(path_.duration) * Real(q_.limits.airspeed);
    if (flown > length * (1 + kRounding))
      note(tally_.false_shortest, "shortest", flown, length);
  }

  void compare_with_flight() {
    const Real flight =
        independent::lattice_time(field_, air_of_query(q_), pose_of(q_.start),
                                  pose_of(q_.goal), q_.limits.turn_radius, 1, 1'000);
    if (!std::isfinite(flight)) return;
    ++tally_.flights;
    if (flight < path_.duration * (1 - kRounding)) ++tally_.quicker;
    if (flight < path_.bound * (1 - kRounding))
      note(tally_.false_bounds, "bound above a flight", path_.bound, flight);
  }

  std::uint32_t number_;
  Problem problem_;
  PathQuery q_;
  PathTally tally_;
  independent::Field field_;
  PlannedPath path_;
  Real point_ = 0, connection_ = 0;
};

}  // namespace

void PathTally::add(const PathTally& other) {
  problems += other.problems;
  paths += other.paths;
  bounds += other.bounds;
  shortest += other.shortest;
  parted += other.parted;
  false_bounds += other.false_bounds;
  false_shortest += other.false_shortest;
  false_parted += other.false_parted;
  false_paths += other.false_paths;
  flights += other.flights;
  quicker += other.quicker;
  if (first.empty()) first = other.first;
}

PathTally check_path_claims(std::uint32_t number) {
  return Check(number, drawn(number)).run();
}

}  // namespace skein::solve::test
