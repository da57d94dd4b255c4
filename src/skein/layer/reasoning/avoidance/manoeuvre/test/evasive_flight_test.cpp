// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/manoeuvre/evasive_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "skein/model/path/flight_plan.h"

namespace skein::reasoning::evasive_flight_test {
namespace {

FlightPlan straight(const Vec3& from, double heading, double duration = 300) {
  FlightElement e;
  e.p_N = from;
  e.heading = heading;
  e.airspeed = 20;
  e.duration = duration;
  return {e};
}

bool anything(const FlightPlan&) {
  return true;
}

// Somebody comes head-on, ten seconds away.
struct Late {
  FlightPlan plan = straight({0, 0, -100}, 0);
  FlightPlan other = straight({400, 0, -100}, geo::kPi);
  Separation kept{50, 20};
  FlightLimits limits;
  ConflictOfFlight conflict{plan, limits, 1, 8.75, 10, 11.25, kept};
};

TEST(EvasiveFlight, MeetsNobodyWhereThatCanBe) {
  const Late late;
  const std::vector<KnownFlight> others = {{&late.other, late.kept}};
  const auto evasive = evasive_flight(late.conflict, others, anything);
  ASSERT_TRUE(evasive);
  EXPECT_TRUE(std::isinf(evasive->meets));
  EXPECT_FALSE(first_encounter(evasive->flight, late.other, late.kept, 1, 61));
  EXPECT_LT(
      (model::end_of(evasive->flight.back()).p_N - model::end_of(late.plan.back()).p_N)
          .norm(),
      1e-3)
      << "it goes on to where the plan goes";
}

TEST(EvasiveFlight, ElsePutsTheMeetingOff) {
  const Late late;
  // A wall of aircraft at all heights and to all sides comes behind the first.
  std::vector<FlightPlan> wall = {late.other};
  for (int across = -30; across <= 30; ++across)
    for (int up = -6; up <= 8; ++up)
      wall.push_back(straight({1200, 60.0 * across, -100 - 25.0 * up}, geo::kPi));
  std::vector<KnownFlight> others;
  for (const FlightPlan& each : wall) others.push_back({&each, late.kept});
  const auto evasive = evasive_flight(late.conflict, others, anything);
  ASSERT_TRUE(evasive);
  EXPECT_GT(evasive->meets, late.conflict.meets + 2);
  EXPECT_LT(evasive->meets, 61);
}

TEST(EvasiveFlight, IsNoneWhereGroundAndZonesLeaveNothing) {
  const Late late;
  const std::vector<KnownFlight> others = {{&late.other, late.kept}};
  EXPECT_FALSE(
      evasive_flight(late.conflict, others, [](const FlightPlan&) { return false; }));
}

}  // namespace
}  // namespace skein::reasoning::evasive_flight_test
