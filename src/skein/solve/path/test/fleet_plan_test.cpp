// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/fleet_plan.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/test/oracle.h"

namespace skein::solve::fleet_plan_test {
namespace {

FleetQuery random_fleet(std::size_t count, double side, double latest) {
  FleetQuery fleet;
  RandomStream draw(3, 0, Purpose::kTest);
  for (std::size_t i = 0; i < count; ++i) {
    const auto state = [&] {
      return FlightState{
          Vec3(draw.uniform(0, side), draw.uniform(0, side), -draw.uniform(100, 250)),
          draw.uniform(-3, 3)};
    };
    FleetMember m;
    m.who = EntityId{static_cast<std::uint32_t>(i)};
    m.start = state();
    m.goal = state();
    m.latest_start = latest;
    fleet.members.push_back(m);
  }
  fleet.common.budget.expansions = 3000;
  return fleet;
}

// Pairs of which one comes into the other's room, by the definition.
int conflicts(const FleetQuery& fleet, const FleetPlan& plan) {
  int found = 0;
  for (std::size_t i = 0; i < plan.paths.size(); ++i)
    for (std::size_t k = 0; k < plan.paths.size(); ++k) {
      const FlightPlan &a = plan.paths[i].plan, &b = plan.paths[k].plan;
      if (i == k || a.empty() || b.empty()) continue;
      const PlannedFlight room{fleet.members[k].who, b, fleet.zone, fleet.height};
      const double begin = std::max(model::start_of(a), model::start_of(b) - 20);
      const double end = std::min(model::end_time_of(a), model::end_time_of(b) + 20);
      for (double t = begin; t < end; t += 0.5) {
        const Vec3 p = model::moment_at(a, t).p_N;
        // What is far away now is looked at more closely only when it may come near.
        if (test::depth(room, p, t, 1.0) < -25) continue;
        if (test::depth(room, p, t, 0.05) > 0.1) {
          ++found;
          break;
        }
      }
    }
  return found;
}

TEST(FleetPlan, KeepsAllFlightsOutOfEachOthersRooms) {
  const FleetQuery fleet = random_fleet(40, 2500, 600);
  const FleetPlan plan = plan_fleet(fleet);
  EXPECT_EQ(plan.planned, 40u);
  EXPECT_EQ(conflicts(fleet, plan), 0);
  // They would meet otherwise.
  FleetPlan straight;
  for (const FleetMember& m : fleet.members) {
    FleetQuery alone = fleet;
    alone.members = {m};
    straight.paths.push_back(plan_fleet(alone).paths.front());
  }
  EXPECT_GT(conflicts(fleet, straight), 5);
}

TEST(FleetPlan, PlansAircraftThatCannotWait) {
  FleetQuery fleet = random_fleet(12, 2500, 0);
  const FleetPlan plan = plan_fleet(fleet);
  EXPECT_EQ(conflicts(fleet, plan), 0);
  EXPECT_GE(plan.planned, 11u);
  for (const PlannedPath& p : plan.paths) {
    if (!p.plan.empty()) {
      EXPECT_EQ(model::start_of(p.plan), 0);
    }
  }
}

TEST(FleetPlan, SaysWhyOneCannotFly) {
  FleetQuery fleet = random_fleet(2, 2500, 60);
  Airspace airspace;
  airspace.zones.push_back({Disc{geo::horizontal(fleet.members[1].goal.p_N), 50}});
  fleet.common.airspace = &airspace;
  const FleetPlan plan = plan_fleet(fleet);
  EXPECT_EQ(plan.planned, 1u);
  EXPECT_EQ(plan.paths[1].outcome, PlanningOutcome::kGoalBlocked);
  EXPECT_FALSE(plan.paths[1].reason.empty());
}

TEST(FleetPlan, EndsWhenItIsStopped) {
  FleetQuery fleet = random_fleet(30, 2500, 80'000);
  int asked = 0;
  fleet.common.budget.stop = [&asked] { return ++asked > 5; };
  const FleetPlan plan = plan_fleet(fleet);
  EXPECT_EQ(plan.paths.size(), 30u);
  EXPECT_LE(plan.planned, 5u);
  EXPECT_LT(asked, 200) << "nothing more is searched";
}

}  // namespace
}  // namespace skein::solve::fleet_plan_test
