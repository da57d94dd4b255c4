// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "skein/base/random.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/aa_star.h"
#include "skein/solve/path/fleet_plan.h"
#include "skein/solve/path/repair.h"
#include "skein/solve/path/test/oracle.h"

// Queries of anything: whatever comes in, an outcome comes out, and what is called a path
// is one.
namespace skein::solve::hostile_test {
namespace {

class Hostile {
 public:
  explicit Hostile(std::uint64_t seed) : random_(seed, 0, Purpose::kTest) {}

  double any(double usual) {
    constexpr double kOdd[] = {0,
                               -0.0,
                               1e-300,
                               1e-9,
                               -1,
                               1e7,
                               -1e7,
                               1e300,
                               std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity()};
    if (random_.uniform() < odd_) return kOdd[random_.bits() % std::size(kOdd)];
    return random_.uniform(-usual, usual);
  }
  double above(double usual) {
    return random_.uniform() < odd_ ? any(usual) : random_.uniform(0.01 * usual, usual);
  }
  Vec2 place(double usual) { return {any(usual), any(usual)}; }
  FlightState state() { return {Vec3(any(1000), any(1000), any(200)), any(7)}; }

  Zone zone() {
    Zone z;
    if (random_.uniform() < 0.5) {
      z.area = Disc{place(1000), above(200)};
    } else {
      geo::Ring ring;
      const auto corners = random_.bits() % 8;
      const Vec2 at = place(1000);
      for (std::uint64_t i = 0; i < corners; ++i)
        ring.push_back(at + above(200) * geo::unit(2 * geo::kPi * static_cast<double>(i) /
                                                   static_cast<double>(corners)));
      if (random_.uniform() < odd_) ring.insert(ring.end(), ring.begin(), ring.end());
      z.area = ring;
    }
    if (random_.uniform() < 0.3) z.floor_msl = any(200);
    if (random_.uniform() < 0.3) z.until = above(100);
    return z;
  }

  PathQuery query(Airspace& airspace) {
    odd_ = random_.uniform() < 0.5 ? 0 : 0.01;
    for (std::uint64_t i = random_.bits() % 4; i > 0; --i)
      airspace.zones.push_back(zone());
    if (random_.uniform() < 0.3)
      airspace.movers.push_back(
          {any(50), state().p_N, Vec3(any(20), any(20), any(1)), above(90), above(50)});
    if (random_.uniform() < 0.3) {
      PlannedFlight f;
      f.plan.push_back({any(50), above(100), state().p_N, any(7), above(30), any(0.3),
                        any(3), place(5)});
      f.zone.across = above(50);
      airspace.flights.push_back(f);
    }
    PathQuery q;
    q.airspace = &airspace;
    q.start = state();
    q.goal = random_.uniform() < 0.05 ? q.start : state();
    q.start_time = any(50);
    q.limits.airspeed = above(40);
    q.limits.turn_radius = above(150);
    q.limits.climb_rate = above(5);
    q.limits.sink_rate = above(5);
    q.wind = place(8);
    q.budget.expansions = 300;
    q.budget.first = random_.uniform() < 0.5;
    if (random_.uniform() < 0.3) q.north_east = Vec2(any(3000), any(3000));
    return q;
  }

 private:
  RandomStream random_;
  double odd_ = 0.01;
};

void expect_a_path(const PathQuery& q, const PlannedPath& path, std::uint64_t seed) {
  EXPECT_LE(path.bound, path.duration) << seed;
  if (path.plan.empty()) return;
  // Rounding grows with the distances.
  const double size = 1 + q.start.p_N.norm() + q.goal.p_N.norm() +
                      q.wind.norm() * path.duration + q.limits.turn_radius;
  const model::FlightMoment end = model::end_of(path.plan.back());
  EXPECT_LE((end.p_N - q.goal.p_N).norm(), 1e-8 * size) << seed;
  EXPECT_LE(test::gaps(path.plan), 1e-8 * size) << seed;
}

TEST(HostileQueries, AlwaysGetAnOutcome) {
  int paths = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    Hostile hostile(seed);
    Airspace airspace;
    const PathQuery q = hostile.query(airspace);
    const PlannedPath path = AaStar().plan(q);
    expect_a_path(q, path, seed);
    path.plan.empty() ? ++refused : ++paths;
    if (path.plan.empty() && path.outcome != PlanningOutcome::kFound) {
      EXPECT_FALSE(path.reason.empty()) << seed << " " << name_of(path.outcome);
    }
    // The same as a repair of anything, and as a fleet.
    const RepairedPath repaired = repair(path.plan, q);
    expect_a_path(q, repaired.path, seed);
    FleetQuery fleet;
    fleet.common = q;
    fleet.members = {{EntityId{1}, q.start, q.goal, 0, 20, q.limits},
                     {EntityId{2}, q.goal, q.start, 0, 20, q.limits}};
    EXPECT_EQ(plan_fleet(fleet).paths.size(), 2u);
  }
  EXPECT_GT(paths, 200);
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace skein::solve::hostile_test
