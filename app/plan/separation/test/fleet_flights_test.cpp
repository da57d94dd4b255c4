// SPDX-License-Identifier: Apache-2.0
// Random fleets in random wind from any side, among random zones: what is planned, held
// against samples that share nothing with the planner.
#include <gtest/gtest.h>

#include "app/plan/separation/separation.h"
#include "skein/base/random.h"
#include "skein/data/airspace/airspace.h"
#include "skein/geo/vec.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/fleet_plan.h"
#include "skein/solve/path/test/oracle.h"

namespace skein::separation::fleet_flights_test {
namespace {

using solve::FleetMember;
using solve::FleetPlan;
using solve::FleetQuery;

constexpr double kSide = 2500;  // of the square that all is in [m]

struct Fleet {
  Airspace airspace;
  FleetQuery query;
};

// A tenth is asked to start at once, some start in flight, all at nearly one altitude.
void make_fleet(std::uint64_t seed, Fleet& fleet) {
  RandomStream draw(seed, 0, Purpose::kTest);
  const double airspeed = draw.uniform(12, 25), bearing = draw.uniform(0, 2 * geo::kPi);
  fleet.query.common.wind = draw.uniform(0, 0.7) * airspeed * geo::unit(bearing);
  for (int i = 0; i < 8; ++i) {
    const Vec2 centre(draw.uniform(0, kSide), draw.uniform(0, kSide));
    if (i % 2 == 0) {
      fleet.airspace.zones.push_back({Disc{centre, draw.uniform(50, 200)}});
      continue;
    }
    geo::Ring ring;  // clockwise, as zones are
    for (int k = 0; k < 5; ++k)
      ring.push_back(centre + draw.uniform(60, 200) * geo::unit(k * 2 * geo::kPi / 5));
    fleet.airspace.zones.push_back({ring});
  }
  fleet.query.common.airspace = &fleet.airspace;
  fleet.query.common.budget.expansions = 1000;
  fleet.query.zone = {draw.uniform(0, 8), draw.uniform(0, 15), draw.uniform(10, 60)};
  fleet.query.height = draw.uniform(5, 40);
  for (std::uint32_t i = 1; i <= 16; ++i) {
    FleetMember m;
    m.who = EntityId{i};
    for (FlightState* s : {&m.start, &m.goal})
      *s = {{draw.uniform(0, kSide), draw.uniform(0, kSide), -draw.uniform(100, 130)},
            draw.uniform(-geo::kPi, geo::kPi)};
    m.earliest_start = draw.uniform(0, 30);
    m.latest_start = m.earliest_start + (i % 10 == 0 ? 0 : 200);
    m.limits.airspeed = airspeed;
    m.limits.turn_radius = draw.uniform(40, 90);
    fleet.query.members.push_back(m);
  }
}

std::vector<FlightPlan> flights_of(const FleetPlan& plan) {
  std::vector<FlightPlan> flights;
  for (const PlannedPath& path : plan.paths) flights.push_back(path.plan);
  return flights;
}

Separation separation_in(const FleetQuery& query, const FleetPlan& plan) {
  SeparationOptions options;
  options.zone = query.zone;
  options.height = query.height;
  return separation_of(flights_of(plan), options);
}

void expect_the_same(const FleetPlan& a, const FleetPlan& b) {
  for (std::size_t i = 0; i < a.paths.size(); ++i) {
    EXPECT_EQ(a.paths[i].outcome, b.paths[i].outcome);
    ASSERT_EQ(a.paths[i].plan.size(), b.paths[i].plan.size());
    for (std::size_t k = 0; k < a.paths[i].plan.size(); ++k) {
      const FlightElement &x = a.paths[i].plan[k], &y = b.paths[i].plan[k];
      EXPECT_TRUE(x.start == y.start && x.duration == y.duration && x.p_N == y.p_N &&
                  x.heading == y.heading && x.turn_rate == y.turn_rate &&
                  x.climb_rate == y.climb_rate);
    }
  }
}

TEST(FleetFlights, KeepOutOfRoomsAndZonesInAnyWind) {
  std::size_t planned = 0, asked = 0;
  std::int64_t alone_in_rooms = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Fleet fleet;
    make_fleet(seed, fleet);
    const FleetPlan plan = solve::plan_fleet(fleet.query);
    planned += plan.planned;
    asked += fleet.query.members.size();
    EXPECT_EQ(separation_in(fleet.query, plan).pairs_in_rooms, 0) << "seed " << seed;
    for (std::size_t i = 0; i < plan.paths.size(); ++i) {
      const FlightPlan& flight = plan.paths[i].plan;
      const FleetMember& member = fleet.query.members[i];
      if (flight.empty()) {
        EXPECT_FALSE(plan.paths[i].reason.empty()) << "seed " << seed;
        continue;
      }
      EXPECT_GE(model::start_of(flight), member.earliest_start);
      EXPECT_LE(model::start_of(flight), member.latest_start);
      EXPECT_NEAR((model::end_of(flight.back()).p_N - member.goal.p_N).norm(), 0, 1e-3);
      for (double t = model::start_of(flight); t < model::end_time_of(flight); t += 0.5)
        for (const Zone& zone : fleet.airspace.zones)
          EXPECT_LT(solve::test::depth(zone, model::moment_at(flight, t).p_N, t), 0.1)
              << "seed " << seed;
    }
    expect_the_same(plan, solve::plan_fleet(fleet.query));
    FleetPlan alone;  // as if there were no others: there is something to keep apart
    for (const FleetMember& member : fleet.query.members) {
      FleetQuery one = fleet.query;
      one.members = {member};
      alone.paths.push_back(solve::plan_fleet(one).paths.front());
    }
    alone_in_rooms += separation_in(fleet.query, alone).pairs_in_rooms;
  }
  EXPECT_GT(alone_in_rooms, 100);
  // Starts and goals within zones cannot be flown.
  EXPECT_GT(static_cast<double>(planned), 0.6 * static_cast<double>(asked));
}

}  // namespace
}  // namespace skein::separation::fleet_flights_test
