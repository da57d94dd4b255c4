// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/intruders/intruder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/reasoning/avoidance/encounter/test/straight_flight.h"
#include "skein/layer/reasoning/avoidance/intruders/flight_around.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/airspace_map.h"

namespace skein::reasoning::intruder_test {
namespace {

AvoidedIntruder head_on() {
  AvoidedIntruder intruder;
  intruder.p_N = Vec3(2400, 0, -100);
  intruder.v_N = Vec3(-40, 0, 0);
  return intruder;
}

TEST(AvoidedIntruder, ItsPlaceIsLessAndLessKnown) {
  AvoidedIntruder intruder;
  intruder.horizontal_sd = 10;
  intruder.horizontal_speed_sd = 1;
  EXPECT_EQ(horizontal_sd_after(intruder, 0), 10);
  EXPECT_NEAR(horizontal_sd_after(intruder, 8),
              std::sqrt(100 + 64 + 1.5 * 1.5 * 8 * 8 * 8 / 3), 1e-9);
  EXPECT_NEAR(horizontal_sd_after(intruder, 12),
              std::sqrt(100 + 100 + 1.5 * 1.5 * 1000 / 3), 1e-9)
      << "as after ten seconds";
  EXPECT_LT(vertical_sd_after(intruder, 12), horizontal_sd_after(intruder, 12));
}

TEST(AvoidedIntruder, AHeadOnIsPredictedWhereTheTwoMeet) {
  const auto encounter = predicted_intersection(straight({0, 0, -100}, 0), head_on(), 0);
  ASSERT_TRUE(encounter);
  EXPECT_NEAR(encounter->closest_time, 40, 1);
  EXPECT_LT(encounter->begin, 32);  // 610 m before at 60 m/s, and what is not known
  EXPECT_LT(encounter->ratio, 0.05);
}

TEST(AvoidedIntruder, WhoPassesFarAwayIsNone) {
  AvoidedIntruder intruder = head_on();
  intruder.p_N.y() = 3000;
  EXPECT_FALSE(predicted_intersection(straight({0, 0, -100}, 0), intruder, 0));
  intruder = head_on();
  intruder.p_N.z() = -600;
  EXPECT_FALSE(predicted_intersection(straight({0, 0, -100}, 0), intruder, 0));
}

// The room is blocked where the intersection is, and moves along.
TEST(AvoidedIntruder, TheRoomMovesWithIt) {
  const auto encounter = predicted_intersection(straight({0, 0, -100}, 0), head_on(), 0);
  Airspace airspace;
  airspace.movers.push_back(room_of(head_on(), *encounter));
  PathQuery query;
  query.airspace = &airspace;
  const solve::AirspaceMap map(query);
  EXPECT_FALSE(map.is_free(straight({0, 0, -100}, 0)));
  EXPECT_TRUE(map.conflict_at(Vec3(2400 - 40 * 35, 0, -100), 35));
  EXPECT_FALSE(map.conflict_at(Vec3(2400 - 40 * 35, 2000, -100), 35));
}

// Whatever is around the intruder while the two are too near lies in the static room, and
// it is no wider than that.
TEST(AvoidedIntruder, TheStaticRoomHoldsAllThatTheMovingOneSweeps) {
  AvoidedIntruder intruder = head_on();
  intruder.v_N = Vec3(-30, 20, 1);
  intruder.p_N = Vec3(2000, -800, -130);
  const auto encounter = predicted_intersection(straight({0, 0, -100}, 0), intruder, 0);
  ASSERT_TRUE(encounter);
  const Zone room = static_room_of(intruder, *encounter);
  for (const double time : {encounter->begin, encounter->closest_time,
                            (encounter->begin + encounter->end) / 2, encounter->end}) {
    const Vec3 place = intruder.p_N + time * intruder.v_N;
    EXPECT_TRUE(covers(room, place.head<2>())) << time;
    EXPECT_LE(room.floor_msl, -place.z() - encounter->kept.vertical + 1e-9);
    EXPECT_GE(room.ceiling_msl, -place.z() + encounter->kept.vertical - 1e-9);
  }
  const Vec2 along = intruder.v_N.head<2>().normalized();
  const double half = (encounter->end - encounter->begin) / 2;
  const Vec2 middle = (intruder.p_N + (encounter->begin + half) * intruder.v_N).head<2>();
  const double b = encounter->kept.horizontal;
  const double a = b + half * intruder.v_N.head<2>().norm();
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(covers(room, middle + side * 0.999 * a * along));
    EXPECT_FALSE(covers(room, middle + side * 1.02 * a * along));
    const Vec2 across = geo::turned_right(along);
    EXPECT_TRUE(covers(room, middle + side * 0.999 * b * across));
    EXPECT_FALSE(covers(room, middle + side * 1.02 * b * across));
  }
  EXPECT_EQ(room.from, encounter->begin - 5);
  EXPECT_EQ(room.until, encounter->end + 5);
}

// The flight around keeps out of the room of the kind that is asked for.
TEST(AvoidedIntruder, TheFlightAroundKeepsOutOfTheRoomThatIsChosen) {
  const FlightPlan plan = straight({0, 0, -100}, 0);
  std::vector<AvoidedIntruder> intruders = {head_on()};
  intruders[0].p_N.x() = 3400;
  PathQuery query;
  const auto flight = [&](IntruderRoom kind) {
    const IntruderView view{
        0, Vec3(0, 0, -100), Vec3(20, 0, 0), plan, 200, intruders, query, {}, {}, kind};
    return flight_around(view, *predicted_intersection(plan, intruders[0], 0), 2);
  };
  const auto standing = flight(IntruderRoom::kStatic);
  ASSERT_TRUE(standing);
  Airspace airspace;
  airspace.zones = {
      static_room_of(intruders[0], *predicted_intersection(plan, intruders[0], 0))};
  query.airspace = &airspace;
  const solve::AirspaceMap map(query);
  EXPECT_TRUE(map.is_free(*standing));
  // Of one that crosses slowly from the right the moving room leaves more way.
  intruders[0].p_N = Vec3(1100, 1000, -100);
  intruders[0].v_N = Vec3(0, -18, 0);
  const auto behind = flight(IntruderRoom::kMoving);
  const auto beside = flight(IntruderRoom::kStatic);
  ASSERT_TRUE(behind);
  ASSERT_TRUE(beside);
  EXPECT_GT(model::end_time_of(*beside), model::end_time_of(*behind) + 1);
}

}  // namespace
}  // namespace skein::reasoning::intruder_test
