// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/manoeuvre/candidates.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace skein::reasoning::candidates_test {
namespace {

// Straight on for 300 s at 20 m/s.
FlightPlan straight(Vec3 from, double heading) {
  FlightElement e;
  e.p_N = from;
  e.heading = heading;
  e.airspeed = 20;
  e.duration = 300;
  return {e};
}

double cost_of(const std::vector<Candidate>& all, const Manoeuvre& manoeuvre) {
  return std::ranges::find(all, manoeuvre, &Candidate::manoeuvre)->cost;
}

struct HeadOn {
  FlightPlan plan = straight({0, 0, -100}, 0);
  FlightLimits limits;
  ConflictOfFlight conflict{plan, limits, 10, 60, 61, 62, {50, 20}};
};

TEST(Candidates, CostWhatTheyDelayAndClimb) {
  const HeadOn on;
  const auto all = candidates(on.conflict, 1, {}, 150);
  EXPECT_EQ(cost_of(all, {ManoeuvreKind::kGoOn}), 0);
  EXPECT_NEAR(cost_of(all, {ManoeuvreKind::kDirect}), 0, 1e-6);
  // Up, and down again to the end.
  EXPECT_NEAR(cost_of(all, {ManoeuvreKind::kUp, 44}), 0.05 * 88, 1e-6);
  const double small = cost_of(all, {ManoeuvreKind::kRight, 30, 50});
  const double large = cost_of(all, {ManoeuvreKind::kRight, 160, 12});
  EXPECT_GT(small, 0);
  EXPECT_LT(small, 1);
  EXPECT_GT(large, small);
  // 54 s at 0.82 of the speed, and the way that is left at cruise.
  EXPECT_NEAR(cost_of(all, {ManoeuvreKind::kSpeed, 0.82F}), 54 * (1 / 0.82 - 1), 1e-4);
}

TEST(Candidates, CostMoreWhereTheyMeetAThirdFlight) {
  const HeadOn on;
  const auto with = [&](const FlightPlan& third) {
    const KnownFlight known{&third, {50, 20}};
    return candidates(on.conflict, 1, {&known, 1}, 150);
  };
  // It crosses the plan at a time; those who climb pass above it.
  const auto crossing_at = [&](double time) {
    return straight({20 * time, -20 * time, -100}, geo::kPi / 2);
  };
  const Manoeuvre up{ManoeuvreKind::kUp, 44}, on_it{ManoeuvreKind::kGoOn};
  EXPECT_EQ(cost_of(with(crossing_at(40)), on_it), 1e4);
  EXPECT_EQ(cost_of(with(crossing_at(75)), on_it), 60);
  EXPECT_EQ(cost_of(with(crossing_at(120)), on_it), 8);
  EXPECT_EQ(cost_of(with(crossing_at(250)), on_it), 0) << "beyond what is looked at";
  const auto soon = with(crossing_at(63));
  EXPECT_EQ(cost_of(soon, on_it), 60);
  EXPECT_NEAR(cost_of(soon, up), 4.4, 1e-6);
}

}  // namespace
}  // namespace skein::reasoning::candidates_test
