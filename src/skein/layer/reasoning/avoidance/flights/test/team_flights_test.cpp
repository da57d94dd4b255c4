// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/flights/team_flights.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/avoidance/flights/execution_errors.h"
#include "skein/model/path/flight_code.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning::team_flights_test {
namespace {

constexpr EntityId kSelf{1}, kOther{2};

FlightPlan north_at(double speed, double duration) {
  FlightElement e;
  e.duration = duration;
  e.airspeed = speed;
  e.p_N = Vec3(0, 0, -100);
  return {e};
}

Message says(decltype(Message::content) content, double sent) {
  return {kOther, kSelf, 0, Time::from_seconds(sent), std::move(content)};
}

PlanReport report(std::uint32_t number, const FlightPlan& plan) {
  PlanReport report;
  report.number = number;
  report.flight = *model::coded_flight(plan);
  return report;
}

PlaceReport place(double north, std::uint32_t plan) {
  PlaceReport place;
  place.north = static_cast<float>(north);
  place.down = -100;
  place.plan = plan;
  return place;
}

TeamFlights after(double now, const std::vector<Message>& messages) {
  TeamFlights flights;
  flights.listen(kSelf, Time::from_seconds(now), messages);
  return flights;
}

TEST(TeamFlights, TheNewestPlanCountsInWhateverOrderTheyCome) {
  const auto flights = after(
      3, {says(report(2, north_at(20, 100)), 2), says(report(1, north_at(15, 100)), 1)});
  ASSERT_TRUE(flights.find(kOther));
  EXPECT_EQ(flights.find(kOther)->number, 2u);
}

TEST(TeamFlights, PlansAndPlacesHoldLongerWhereTheyAreSaidMoreRarely) {
  const std::vector<Message> messages = {says(report(2, north_at(20, 100)), 2)};
  TeamFlights often(90, 1), rarely(90, 4);
  often.listen(kSelf, Time::from_seconds(2), messages);
  rarely.listen(kSelf, Time::from_seconds(2), messages);
  const Time later = Time::from_seconds(40);
  EXPECT_FALSE(often.find(kOther)->conforms(later));
  EXPECT_TRUE(rarely.find(kOther)->conforms(later));
  EXPECT_FALSE(rarely.find(kOther)->conforms(Time::from_seconds(63)));
  // Places that come every fourth second are all that there are.
  std::vector<Message> places;
  for (int k = 0; k < 40; ++k) places.push_back(says(place(80.0 * k, 2), 4 * k));
  rarely.listen(kSelf, Time::from_seconds(160), places);
  often.listen(kSelf, Time::from_seconds(160), places);
  EXPECT_EQ(rarely.loss(), 0);
  EXPECT_NEAR(often.loss(), 0.75, 0.01);
}

TEST(TeamFlights, WhoHasLandedIsInNobodysWayUntilItFliesAgain) {
  LandingReport landed;
  landed.phase = LandingPhase::kLanded;
  const std::vector<Message> before = {says(report(2, north_at(20, 100)), 2),
                                       says(place(40, 2), 3)};
  TeamFlights flights = after(3, before);
  ASSERT_TRUE(flights.find(kOther)->expected(Time::from_seconds(3)).plan);
  const std::vector<Message> late = {says(landed, 4), before[0], before[1]};
  flights.listen(kSelf, Time::from_seconds(5), late);
  EXPECT_FALSE(flights.find(kOther)->expected(Time::from_seconds(5)).plan);
  const std::vector<Message> again = {says(report(3, north_at(20, 100)), 6)};
  flights.listen(kSelf, Time::from_seconds(6), again);
  EXPECT_TRUE(flights.find(kOther)->expected(Time::from_seconds(6)).plan);
}

TEST(TeamFlights, TheSameTwiceIsOnce) {
  const Message plan = says(report(2, north_at(20, 100)), 2);
  EXPECT_EQ(after(3, {plan, plan}).flights().size(), 1u);
}

TEST(TeamFlights, WhoHasBegunAnewCountsFromOne) {
  TeamFlights flights = after(3, {says(report(7, north_at(20, 100)), 2)});
  const Message again = says(report(1, north_at(20, 100)), 40);
  flights.listen(kSelf, Time::from_seconds(41), std::span(&again, 1));
  EXPECT_EQ(flights.find(kOther)->number, 1u);
}

TEST(TeamFlights, APlanThatIsNotKeptProtectsNobody) {
  const Message plan = says(report(1, north_at(20, 100)), 2);
  const Time now = Time::from_seconds(10);
  EXPECT_TRUE(after(10, {plan, says(place(205, 1), 10)}).find(kOther)->conforms(now));
  EXPECT_FALSE(after(10, {plan, says(place(300, 1), 10)}).find(kOther)->conforms(now));
}

TEST(TeamFlights, WhoIsOffItsPlanIsExpectedStraightOn) {
  const Message plan = says(report(1, north_at(20, 100)), 2);
  PlaceReport off = place(300, 1);
  off.v_east = 10;
  off.v_down = -2;
  const auto flights = after(10, {plan, says(off, 10)});
  const TeamFlight& other = *flights.find(kOther);
  const auto expected = other.expected(Time::from_seconds(10));
  ASSERT_TRUE(expected.plan);
  EXPECT_NE(expected.number, 1u);
  // It climbs for six seconds and is level then.
  const Vec3 later = model::moment_at(*expected.plan, 20).p_N;
  EXPECT_LT((later - Vec3(300, 100, -112)).norm(), 1e-6);
  EXPECT_FALSE(other.expected(Time::from_seconds(25)).plan) << "it may be anywhere";
  const auto kept = after(10, {plan, says(place(205, 1), 10)});
  EXPECT_EQ(kept.find(kOther)->expected(Time::from_seconds(10)).number, 1u);
}

TEST(TeamFlights, ASilentOnesPlanProtectsItNoMore) {
  const auto flights = after(3, {says(report(1, north_at(20, 100)), 2)});
  EXPECT_TRUE(flights.find(kOther)->conforms(Time::from_seconds(15)));
  EXPECT_FALSE(flights.find(kOther)->conforms(Time::from_seconds(25)));
}

TEST(TeamFlights, WhatMakesNoSenseChangesNothing) {
  PlanReport bad = report(3, north_at(20, 100));
  bad.flight.pop_back();
  PlanReport odd = report(4, north_at(20, 100));
  odd.across_error = -1;
  const auto flights =
      after(3, {says(report(2, north_at(20, 100)), 1), says(bad, 2), says(odd, 2.5),
                says(report(9, north_at(20, 100)), 50)});  // sent later than now
  EXPECT_EQ(flights.find(kOther)->number, 2u);
}

TEST(ExecutionErrors, BeginWideGrowAtOnceAndShrinkSlowly) {
  ExecutionErrors errors;
  EXPECT_EQ(errors.across(), 8);
  EXPECT_EQ(errors.height(), 2);
  for (int k = 0; k <= 60; ++k) errors.add(Time::from_seconds(k), Vec3(0.1, 0, 0));
  EXPECT_NEAR(errors.across(), 8 * 0.9, 0.1);
  for (int k = 61; k <= 66; ++k) errors.add(Time::from_seconds(k), Vec3(40, 30, 9));
  EXPECT_EQ(errors.across(), 50);
  EXPECT_EQ(errors.height(), 9);
}

}  // namespace
}  // namespace skein::reasoning::team_flights_test
