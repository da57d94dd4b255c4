// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/flight_code.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/random.h"
#include "skein/model/path/flight_plan.h"

namespace skein::model::flight_code_test {
namespace {

// A flight of some straights, turns, climbs and vertical turns, in a wind.
FlightPlan some_flight(std::uint32_t seed) {
  RandomStream random(seed, 1, Purpose::kTest);
  FlightPlan plan;
  FlightElement e;
  e.start = random.uniform(0, 5000);
  e.p_N = Vec3(random.uniform(-5000, 5000), random.uniform(-5000, 5000), -200);
  e.heading = random.uniform(-3, 3);
  e.wind = Vec2(random.uniform(-8, 8), random.uniform(-8, 8));
  double climb = 0;
  for (int k = 0; k < 12; ++k) {
    e.duration = random.uniform(0.5, 60);
    e.airspeed = random.uniform(12, 28);
    e.turn_rate = random.uniform() < 0.5 ? 0 : random.uniform(-0.4, 0.4);
    e.climb_rate = climb;
    e.climb_acceleration = 0;
    if (random.uniform() < 0.4) {
      const double next = k == 11 ? 0 : random.uniform(-3, 3);
      e.climb_acceleration = (next - climb) / e.duration;
      climb = next;
    }
    plan.push_back(e);
    const FlightMoment end = end_of(e);
    e.start += e.duration;
    e.p_N = end.p_N;
    e.heading = end.heading;
  }
  return plan;
}

TEST(FlightCode, KeepsAFlightToDecimetres) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const FlightPlan plan = some_flight(seed);
    const auto coded = coded_flight(plan);
    ASSERT_TRUE(coded) << seed;
    EXPECT_LE(coded->size(), 25u + 10u * plan.size()) << seed;
    const auto again = decoded_flight(*coded);
    ASSERT_TRUE(again) << seed;
    EXPECT_NEAR(end_time_of(*again), end_time_of(plan), 2e-3);
    for (double share = 0; share <= 1; share += 0.01) {
      const double time = start_of(plan) + share * duration(plan);
      // Airspeeds are rounded to 5 mm/s, of which 12 add up at random.
      EXPECT_LT((moment_at(*again, time).p_N - moment_at(plan, time).p_N).norm(), 1.0)
          << "seed " << seed << " at " << share;
    }
  }
}

TEST(FlightCode, WhatWasDecodedIsCodedTheSameAgain) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const auto once = decoded_flight(*coded_flight(some_flight(seed)));
    const auto twice = decoded_flight(*coded_flight(*once));
    ASSERT_TRUE(twice);
    for (double share = 0; share <= 1; share += 0.05) {
      const double time = start_of(*once) + share * duration(*once);
      EXPECT_LT((moment_at(*twice, time).p_N - moment_at(*once, time).p_N).norm(), 0.1);
    }
  }
}

TEST(FlightCode, LongTurnsAreSentInParts) {
  FlightElement circle;
  circle.duration = 3600;
  circle.airspeed = 20;
  circle.turn_rate = 1.0 / 3;
  const auto again = decoded_flight(*coded_flight({circle}));
  ASSERT_TRUE(again);
  EXPECT_GT(again->size(), 1u);
  for (double time = 0; time < 3600; time += 30)
    EXPECT_LT((moment_at(*again, time).p_N - position(circle, time)).norm(), 0.5);
}

TEST(FlightCode, WhatAnElementDoesNotDoTakesNoBytes) {
  FlightElement straight;
  straight.duration = 60;
  straight.airspeed = 20;
  FlightPlan plan = {straight};
  EXPECT_EQ(coded_flight(plan)->size(), 25u + 3 + 2) << "an airspeed";
  const auto go_on = [&](double turn_rate, double climb_rate, double airspeed) {
    FlightElement e = plan.back();
    const FlightMoment end = end_of(e);
    e.start += e.duration;
    e.p_N = end.p_N;
    e.heading = end.heading;
    e.turn_rate = turn_rate;
    e.climb_rate = climb_rate;
    e.airspeed = airspeed;
    plan.push_back(e);
    return coded_flight(plan)->size();
  };
  EXPECT_EQ(go_on(0, 0, 20), 30u + 3);
  EXPECT_EQ(go_on(0.1, 0, 20), 33u + 6) << "a turn";
  EXPECT_EQ(go_on(0, 2, 20), 39u + 5) << "a climb";
  EXPECT_EQ(go_on(-0.1, -2, 18), 44u + 10);
  const auto again = decoded_flight(*coded_flight(plan));
  ASSERT_TRUE(again);
  for (double time = 0; time < 300; time += 7)
    EXPECT_LT((moment_at(*again, time).p_N - moment_at(plan, time).p_N).norm(), 0.1);
}

TEST(FlightCode, AnotherWindOrAJumpBeginsAnotherBlock) {
  FlightPlan plan = some_flight(3);
  for (FlightElement& e : plan) e.wind = Vec2::Zero();
  for (std::size_t k = 0; k < plan.size(); ++k) {
    if (k > 0) plan[k].p_N = end_of(plan[k - 1]).p_N;
    if (k >= 6) plan[k].wind = Vec2(1, 2);
    plan[k].climb_rate = plan[k].climb_acceleration = 0;
  }
  auto coded = coded_flight(plan);
  ASSERT_TRUE(coded);
  const std::size_t joined = coded->size();
  EXPECT_EQ(coded_flight({plan.begin(), plan.begin() + 6})->size() +
                coded_flight({plan.begin() + 6, plan.end()})->size(),
            joined + 19)
      << "place and time are not said again";
  auto again = decoded_flight(*coded);
  ASSERT_TRUE(again);
  for (double share = 0; share <= 1; share += 0.01) {
    const double time = start_of(plan) + share * duration(plan);
    EXPECT_LT((moment_at(*again, time).p_N - moment_at(plan, time).p_N).norm(), 1.0);
  }
  for (std::size_t k = 6; k < plan.size(); ++k) plan[k].p_N.x() += 100;
  coded = coded_flight(plan);
  ASSERT_TRUE(coded);
  EXPECT_EQ(coded->size(), joined + 19);
  again = decoded_flight(*coded);
  ASSERT_TRUE(again);
  EXPECT_LT((moment_at(*again, plan[6].start + 0.1).p_N -
             moment_at(plan, plan[6].start + 0.1).p_N)
                .norm(),
            0.1);
}

TEST(FlightCode, ABlockBehindATurnToAClimbSaysWhereItBegins) {
  FlightElement turn;
  turn.duration = 4;
  turn.airspeed = 20;
  turn.climb_acceleration = 0.5;
  FlightElement climb = turn;
  climb.start = 4;
  climb.p_N = end_of(turn).p_N;
  climb.climb_rate = 2;
  climb.climb_acceleration = 0;
  climb.wind = Vec2(3, 0);
  climb.duration = 30;
  const FlightPlan plan = {turn, climb};
  const auto again = decoded_flight(*coded_flight(plan));
  ASSERT_TRUE(again);
  EXPECT_LT((moment_at(*again, 30).p_N - moment_at(plan, 30).p_N).norm(), 0.1);
}

TEST(FlightCode, WhatLastsNoMillisecondIsNotJoined) {
  FlightElement moment;
  moment.duration = 1e-4;
  moment.airspeed = 20;
  FlightElement straight = moment;
  straight.start = moment.duration;
  straight.p_N = end_of(moment).p_N;
  straight.wind = Vec2(3, 0);
  straight.duration = 30;
  const auto again = decoded_flight(*coded_flight({moment, straight}));
  ASSERT_TRUE(again);
  EXPECT_LT((moment_at(*again, 20).p_N - position(straight, 20)).norm(), 0.1);
}

TEST(FlightCode, NothingIsThereToJoinAtTheBegin) {
  auto coded = *coded_flight(some_flight(1));
  coded[1] |= 0x80;
  EXPECT_FALSE(decoded_flight(coded));
}

TEST(FlightCode, RefusesWhatIsNoFlight) {
  EXPECT_FALSE(coded_flight({}));
  FlightPlan plan = some_flight(1);
  plan[2].p_N.x() = std::nan("");
  EXPECT_FALSE(coded_flight(plan));
  plan = some_flight(1);
  plan[0].p_N.x() = 1e9;  // further than fits
  EXPECT_FALSE(coded_flight(plan));
  const auto coded = *coded_flight(some_flight(1));
  EXPECT_FALSE(decoded_flight({}));
  for (std::size_t cut = 1; cut < coded.size(); ++cut)
    EXPECT_FALSE(decoded_flight(std::span(coded).first(cut))) << cut;
}

}  // namespace
}  // namespace skein::model::flight_code_test
