// SPDX-License-Identifier: Apache-2.0
// Planners of paths.
#include <cmath>
#include <limits>

#include "skein/base/math.h"
#include "skein/data/airspace/airspace.h"
#include "skein/role/contract/checks.h"
#include "skein/role/path_planner.h"

namespace skein::contract {
namespace {

constexpr double kJoint = 1e-3;  // between elements that join [m]

// Where an element is `t` after its start: a line, a circle or a helix in moving air.
Vec3 position(const FlightElement& e, double t) {
  const double turned = e.turn_rate * t;
  Vec2 through_air = e.airspeed * t * geo::unit(e.heading);
  if (e.turn_rate != 0) {
    const double radius = e.airspeed / e.turn_rate, to = e.heading + turned;
    through_air = {radius * (math::sin(to) - math::sin(e.heading)),
                   radius * (math::cos(e.heading) - math::cos(to))};
  }
  const Vec2 over_ground = through_air + t * e.wind;
  const double climbed = e.climb_rate * t + e.climb_acceleration * t * t / 2;
  return e.p_N + Vec3(over_ground.x(), over_ground.y(), -climbed);
}

// An aircraft, a way to go of a few kilometres, often to another altitude, and discs that
// leave both ends free. Some of the aircraft change their climb rate slowly.
PathQuery some_query(RandomStream& random, Airspace& airspace) {
  PathQuery query;
  query.start.p_N << place_within(random, 2000), -120;
  query.goal.p_N << place_within(random, 2000), random.uniform(-250, -120);
  query.start.heading = random.uniform(-geo::kPi, geo::kPi);
  query.goal.heading = random.uniform(-geo::kPi, geo::kPi);
  query.start_time = random.uniform(0, 1000);
  query.limits.airspeed = random.uniform(12, 30);
  query.limits.turn_radius = random.uniform(30, 120);
  query.wind = place_within(random, 5);
  if (random.uniform() < 0.5) query.limits.climb_acceleration = random.uniform(0.3, 3);
  query.budget.expansions = 3000;
  for (int k = 0; k < 4; ++k) {
    const Disc disc{place_within(random, 1500), random.uniform(50, 250)};
    const auto clear = [&](const FlightState& end) {
      return (geo::horizontal(end.p_N) - disc.centre).norm() > disc.radius + 300;
    };
    if (!clear(query.start) || !clear(query.goal)) continue;
    Zone zone;
    zone.area = disc;
    airspace.zones.push_back(zone);
  }
  query.airspace = &airspace;
  return query;
}

void check_plan(const PathQuery& query, const PlannedPath& path, Checks& checks) {
  const FlightPlan& plan = path.plan;
  checks.expect(
      (plan.front().p_N - query.start.p_N).norm() < kJoint &&
          std::abs(geo::wrap_pi(plan.front().heading - query.start.heading)) < 1e-6 &&
          std::abs(plan.front().start - query.start_time) < 1e-6,
      "a plan does not begin at the start");
  const FlightElement& last = plan.back();
  checks.expect((position(last, last.duration) - query.goal.p_N).norm() < kJoint,
                "a plan does not end at the goal");
  double duration = 0, climb_rate = 0;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const FlightElement& e = plan[i];
    duration += e.duration;
    const bool smooth = query.limits.climb_acceleration == 0 ||
                        std::abs(e.climb_rate - climb_rate) < kJoint;
    checks.expect(smooth, "a plan's climb rate jumps");
    climb_rate = e.climb_rate + e.climb_acceleration * e.duration;
    checks.expect(
        std::abs(e.climb_acceleration) <= query.limits.climb_acceleration * (1 + 1e-9),
        "a plan's climb rate changes faster than the aircraft's can");
    checks.expect(e.climb_rate <= query.limits.climb_rate * (1 + 1e-9) &&
                      -e.climb_rate <= query.limits.sink_rate * (1 + 1e-9),
                  "a plan climbs or sinks faster than the aircraft can");
    checks.expect(e.duration >= 0 && e.p_N.allFinite(), "a plan has odd elements");
    checks.expect(std::abs(e.turn_rate) * query.limits.turn_radius <=
                      query.limits.airspeed * (1 + 1e-9),
                  "a plan turns tighter than the aircraft can");
    checks.expect(i + 1 == plan.size() ||
                      (position(e, e.duration) - plan[i + 1].p_N).norm() < kJoint,
                  "the elements of a plan do not join");
    for (int k = 0; k <= 20; ++k)
      for (const Zone& zone : query.airspace->zones) {
        const Vec2 p = geo::horizontal(position(e, e.duration * k / 20));
        const auto& disc = std::get<Disc>(zone.area);
        checks.expect((p - disc.centre).norm() > disc.radius - kJoint,
                      "a plan leads through a zone");
      }
  }
  checks.expect(query.limits.climb_acceleration == 0 || std::abs(climb_rate) < kJoint,
                "a plan does not end level");
  checks.expect(std::abs(duration - path.duration) < 1e-6 * (1 + duration),
                "duration is not that of the plan");
  checks.expect(path.bound <= path.duration * (1 + 1e-9),
                "a path is quicker than its bound");
}

void check_refusals(const PathPlanner& planner, const PathQuery& good, Checks& checks) {
  PathQuery query = good;
  query.start.p_N.x() = std::numeric_limits<double>::quiet_NaN();
  checks.expect(planner.plan(query).outcome == PlanningOutcome::kBadQuery,
                "a query without numbers is not refused");
  query = good;
  query.wind = Vec2(query.limits.airspeed, 0);
  checks.expect(planner.plan(query).plan.empty(),
                "it plans in wind that no aircraft can fly against");
  query = good;
  Airspace blocked;
  Zone zone;
  zone.area = Disc{geo::horizontal(query.start.p_N), 50};
  blocked.zones.push_back(zone);
  query.airspace = &blocked;
  checks.expect(planner.plan(query).outcome == PlanningOutcome::kStartBlocked,
                "a start inside a zone is not reported");
}

}  // namespace

Violations planner_violations(const Make<PathPlanner>& make) {
  Checks checks;
  const auto planner = make(), twin = make();
  RandomStream random = draws(41);
  for (int i = 0; i < 25; ++i) {
    Airspace airspace;
    const PathQuery query = some_query(random, airspace);
    const PlannedPath path = planner->plan(query);
    const PlannedPath same = twin->plan(query);
    checks.expect(path.outcome == same.outcome && path.plan.size() == same.plan.size() &&
                      path.expansions == same.expansions &&
                      path.duration == same.duration,
                  "two equal ones do not plan alike");
    const bool planned = path.outcome == PlanningOutcome::kFound ||
                         path.outcome == PlanningOutcome::kBudgetEnded;
    checks.expect(planned != path.plan.empty(), "outcome and plan do not agree");
    checks.expect(planned || !path.reason.empty(), "no path, and no reason why");
    if (!path.plan.empty()) check_plan(query, path, checks);
    if (i == 0) check_refusals(*planner, query, checks);
  }
  return checks.take();
}

}  // namespace skein::contract
