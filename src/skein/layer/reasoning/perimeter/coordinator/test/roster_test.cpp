// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/roster.h"

#include <gtest/gtest.h>

#include <array>

namespace skein::perimeter::roster_test {
namespace {

AircraftReport report(double time, bool obeys = true) {
  AircraftReport report;
  report.nav.time = Time::from_seconds(time);
  report.obeys = obeys;
  report.limits = FlightLimits();
  return report;
}

TEST(Roster, CountsOnNobodyOfWhomItDoesNotKnowHowHeFlies) {
  const std::array team = {EntityId{1}};
  Roster roster(team, 5);
  AircraftReport first = report(1);
  first.limits.reset();
  roster.take(first, EntityId{1}, Time::from_seconds(1));
  EXPECT_FALSE(roster.members()[0].available);
  AircraftReport second = report(2);
  second.limits->turn_radius = 123;
  roster.take(second, EntityId{1}, Time::from_seconds(2));
  EXPECT_TRUE(roster.members()[0].available);
  AircraftReport third = report(3);
  third.limits.reset();
  roster.take(third, EntityId{1}, Time::from_seconds(3));
  EXPECT_TRUE(roster.members()[0].available);
  EXPECT_EQ(roster.members()[0].status.limits.turn_radius, 123);
}

TEST(Roster, DoesNotCountOnAnAircraftThatAFailsafeOrAPilotFlies) {
  const std::array team = {EntityId{1}, EntityId{2}};
  Roster roster(team, 5);
  EXPECT_TRUE(roster.take(report(1), EntityId{1}, Time::from_seconds(1)));
  EXPECT_TRUE(roster.find(EntityId{1})->available);
  roster.find(EntityId{1})->forced = true;
  roster.take(report(2, false), EntityId{1}, Time::from_seconds(2));
  EXPECT_FALSE(roster.find(EntityId{1})->available);
  EXPECT_FALSE(roster.find(EntityId{1})->forced);
  EXPECT_TRUE(roster.update(Time::from_seconds(9)).empty()) << "it was given up already";
  // Back under orders its clocks start anew.
  roster.take(report(10), EntityId{1}, Time::from_seconds(10));
  EXPECT_TRUE(roster.find(EntityId{1})->available);
  EXPECT_EQ(roster.find(EntityId{1})->deployed, Time::from_seconds(10));
}

TEST(Roster, ReportsWhoFallsSilentOnce) {
  const std::array team = {EntityId{1}};
  Roster roster(team, 5);
  roster.take(report(1), EntityId{1}, Time::from_seconds(1));
  EXPECT_TRUE(roster.update(Time::from_seconds(6)).empty());
  EXPECT_EQ(roster.update(Time::from_seconds(6.5)).size(), 1u);
  EXPECT_TRUE(roster.update(Time::from_seconds(7)).empty());
}

TEST(Roster, TakesNoReportsOfOthersAndNoneThatWereOvertaken) {
  const std::array team = {EntityId{1}};
  Roster roster(team, 5);
  EXPECT_FALSE(roster.take(report(1), EntityId{7}, Time::from_seconds(1)));
  roster.take(report(3, false), EntityId{1}, Time::from_seconds(3));
  roster.take(report(2, true), EntityId{1}, Time::from_seconds(4));
  EXPECT_FALSE(roster.find(EntityId{1})->available) << "what it said before is older";
}

}  // namespace
}  // namespace skein::perimeter::roster_test
