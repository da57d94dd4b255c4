// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/leg_plan.h"

#include "skein/data/airspace/airspace.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::reasoning {
namespace {

constexpr std::int64_t kExpansions = 3000;  // of a planner, for one leg
constexpr double kPlanRadius = 1.1;         // of the turn radius: room to correct

}  // namespace

PlannedPath plan_leg(const Legs& legs, const FlightContext& context, const AgentInput& in,
                     const ZoneMonitor& zones, const Vec2& goal, double course) {
  const NavEstimate& nav = *in.nav;
  const Vec2 here = geo::horizontal(nav.p_N);
  Airspace airspace;
  airspace.zones = zones.obstacles(here, goal);
  PathQuery query;
  query.limits = context.limits;
  query.limits.turn_radius *= kPlanRadius;
  if (legs.airspeed) query.limits.airspeed = *legs.airspeed;
  query.start = {{here.x(), here.y(), -legs.altitude_msl}, nav.heading};
  query.goal = {{goal.x(), goal.y(), -legs.altitude_msl},
                model::heading_for_course(course, query.limits.airspeed, nav.wind_N)
                    .value_or(course)};
  query.start_time = in.now.seconds();
  query.wind = nav.wind_N;
  query.ground_clearance = legs.ground_clearance;
  query.airspace = &airspace;
  query.terrain = context.map;
  query.budget.expansions = kExpansions;
  return context.planner->plan(query);
}

}  // namespace skein::reasoning
