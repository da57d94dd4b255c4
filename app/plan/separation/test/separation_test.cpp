// SPDX-License-Identifier: Apache-2.0
#include "app/plan/separation/separation.h"

#include <gtest/gtest.h>

#include "skein/geo/vec.h"

namespace skein::separation::separation_test {
namespace {

FlightPlan straight(double north, double east, double heading_deg, double altitude,
                    double start = 0, double duration = 100) {
  FlightElement e;
  e.start = start;
  e.duration = duration;
  e.p_N = {north, east, -altitude};
  e.heading = geo::radians(heading_deg);
  e.airspeed = 10;
  return {e};
}

Separation look(const std::vector<FlightPlan>& flights, double height = 20) {
  SeparationOptions options;
  options.height = height;
  return separation_of(flights, options);
}

TEST(Separation, IsThatOfFlightsThatCross) {
  // They cross at (0, 500), one 4 s after the other: nearest half-way, 40 m / sqrt(2).
  const Separation found =
      look({straight(-500, 500, 0, 100), straight(0, 0, 90, 100, 4)});
  ASSERT_TRUE(found.nearest);
  EXPECT_NEAR(found.nearest->distance, 40 / std::sqrt(2), 0.01);
  EXPECT_NEAR(found.nearest->time, 52, 0.1);
  // Where one is the other was 4 s before: within 10 s it meets its room.
  EXPECT_EQ(found.pairs, 1);
  EXPECT_EQ(found.pairs_in_rooms, 1);
  ASSERT_TRUE(found.nearest_room);
  EXPECT_LT(found.nearest_room->distance, 1.5);
}

TEST(Separation, ARoomEndsInTimeHeightAndBreadth) {
  const FlightPlan own = straight(-500, 500, 0, 100);
  // The other comes 9.9 s later, within the 10 s behind; or so late that it passes
  // 45 m / sqrt(2) from the room's end.
  EXPECT_EQ(look({own, straight(0, 0, 90, 100, 9.9)}).pairs_in_rooms, 1);
  EXPECT_EQ(look({own, straight(0, 0, 90, 100, 14.5)}).pairs_in_rooms, 0);
  EXPECT_EQ(look({own, straight(0, 0, 90, 119, 2)}).pairs_in_rooms, 1);
  EXPECT_EQ(look({own, straight(0, 0, 90, 121, 2)}).pairs_in_rooms, 0);
  EXPECT_EQ(look({own, straight(-500, 529.8, 0, 100)}).pairs_in_rooms, 1);
  const Separation beside = look({own, straight(-500, 530, 0, 100)});
  EXPECT_EQ(beside.pairs_in_rooms, 0);
  EXPECT_NEAR(beside.nearest_room->distance, 30, 1e-6);
}

TEST(Separation, CountsEachPairOnceAndNamesTheNearest) {
  const Separation found = look({straight(0, 0, 0, 100),
                                 {},
                                 straight(0, 15, 0, 100),
                                 straight(0, 40, 0, 100),
                                 straight(0, 90, 0, 100)});
  EXPECT_EQ(found.pairs, 6);
  EXPECT_EQ(found.pairs_in_rooms, 2);
  EXPECT_EQ(found.nearest->a, 0u);
  EXPECT_EQ(found.nearest->b, 2u) << "the number in the list, with the empty one";
  EXPECT_NEAR(found.nearest->distance, 15, 1e-9);
}

TEST(Separation, OfFlightsThatNeverMeetInTimeIsNone) {
  const Separation found =
      look({straight(0, 0, 0, 100, 0, 10), straight(0, 0, 0, 100, 50, 10)});
  EXPECT_FALSE(found.nearest);
  EXPECT_FALSE(found.nearest_room);
  EXPECT_EQ(found.pairs_in_rooms, 0);
  EXPECT_FALSE(look({}).nearest);
}

TEST(Separation, FollowsTurnsInWindAndClimbs) {
  // A quarter turn to the right of 100 m in wind from the west ends at (100, 100 + 5 t).
  FlightElement turn;
  turn.airspeed = 10;
  turn.turn_rate = 0.1;
  turn.duration = geo::kPi / 2 / 0.1;
  turn.wind = {0, 5};
  turn.climb_rate = 1;
  turn.climb_acceleration = 0.2;
  const double t = turn.duration, climbed = t + 0.1 * t * t;
  FlightElement there;
  there.p_N = {100, 100 + 5 * t, -climbed};
  there.start = t;
  there.duration = 1;
  there.airspeed = 0.001;
  const Separation found = look({{turn}, {there}});
  ASSERT_TRUE(found.nearest);
  EXPECT_NEAR(found.nearest->distance, 0, 1e-9);
}

}  // namespace
}  // namespace skein::separation::separation_test
