// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/flights/conflicts.h"

#include <gtest/gtest.h>

#include "skein/base/math.h"
#include "skein/layer/reasoning/avoidance/encounter/test/straight_flight.h"

namespace skein::reasoning::conflicts_test {
namespace {

TeamFlight other_with(FlightPlan plan) {
  TeamFlight other;
  other.who = EntityId{2};
  other.plan = std::move(plan);
  other.number = 1;
  return other;
}

TEST(ConflictFinder, SeesHeadOnsWithinTheHorizonOnly) {
  const OwnFlight own{straight(Vec3(0, 0, -100), 0), 1, {50, 20}};
  const std::vector<TeamFlight> others = {
      other_with(straight(Vec3(2000, 0, -100), geo::kPi))};
  ConflictFinder finder;
  EXPECT_TRUE(finder.find(Time(), own, others, 40).empty());
  const auto found = finder.find(Time(), own, others, 60);
  ASSERT_EQ(found.size(), 1u);
  // 50 m and what both are off, 8 m each: 66 m are left after 1934 m at 40 m/s.
  EXPECT_NEAR(found[0].encounter.begin, 1934.0 / 40, 0.01);
  EXPECT_EQ(found[0].separation.horizontal, 66);
  EXPECT_EQ(found[0].separation.vertical, 24);
}

TEST(ConflictFinder, LooksAnewWhenAPlanIsAnother) {
  const OwnFlight own{straight(Vec3(0, 0, -100), 0), 1, {50, 20}};
  std::vector<TeamFlight> others = {other_with(straight(Vec3(2000, 0, -100), geo::kPi))};
  ConflictFinder finder;
  EXPECT_EQ(finder.find(Time(), own, others, 60).size(), 1u);
  others[0].plan = straight(Vec3(2000, 0, -140), geo::kPi);
  EXPECT_EQ(finder.find(Time(), own, others, 60).size(), 1u);  // the same number
  others[0].number = 2;
  EXPECT_TRUE(finder.find(Time(), own, others, 60).empty());
}

// How far aircraft are off their plans changes by metres all the time.
TEST(ConflictFinder, MetresOfSeparationMakeNoConflictOfWhatWasApart) {
  OwnFlight own{straight(Vec3(0, 0, -100), 0), 1, {50, 20}};
  // 67 m aside: a metre more than what is kept.
  const std::vector<TeamFlight> others = {
      other_with(straight(Vec3(2000, 67, -100), geo::kPi))};
  ConflictFinder finder;
  EXPECT_TRUE(finder.find(Time(), own, others, 60).empty());
  own.across_error += 3;
  EXPECT_TRUE(finder.find(Time(), own, others, 60).empty());
  own.across_error += 1;
  EXPECT_EQ(finder.find(Time(), own, others, 60).size(), 1u);
  own.across_error -= 3;
  EXPECT_EQ(finder.find(Time(), own, others, 60).size(), 1u)
      << "nor is one over for them";
}

TEST(ConflictFinder, TheEarliestComesFirst) {
  const OwnFlight own{straight(Vec3(0, 0, -100), 0), 1, {50, 20}};
  std::vector<TeamFlight> others = {other_with(straight(Vec3(2000, 0, -100), geo::kPi)),
                                    other_with(straight(Vec3(1000, 0, -100), geo::kPi))};
  others[1].who = EntityId{3};
  ConflictFinder finder;
  const auto found = finder.find(Time(), own, others, 100);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].other.value, 3u);
}

}  // namespace
}  // namespace skein::reasoning::conflicts_test
