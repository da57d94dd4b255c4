// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/strangers/stranger.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/reasoning/avoidance/meeting/test/straight_flight.h"
#include "skein/layer/reasoning/avoidance/strangers/flight_around.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/airspace_map.h"

namespace skein::reasoning::stranger_test {
namespace {

Stranger head_on() {
  Stranger stranger;
  stranger.p_N = Vec3(2400, 0, -100);
  stranger.v_N = Vec3(-40, 0, 0);
  return stranger;
}

TEST(Stranger, ItsPlaceIsLessAndLessKnown) {
  Stranger stranger;
  stranger.horizontal_sd = 10;
  stranger.horizontal_speed_sd = 1;
  EXPECT_EQ(horizontal_sd_after(stranger, 0), 10);
  EXPECT_NEAR(horizontal_sd_after(stranger, 8),
              std::sqrt(100 + 64 + 1.5 * 1.5 * 8 * 8 * 8 / 3), 1e-9);
  EXPECT_NEAR(horizontal_sd_after(stranger, 12),
              std::sqrt(100 + 100 + 1.5 * 1.5 * 1000 / 3), 1e-9)
      << "as after ten seconds";
  EXPECT_LT(vertical_sd_after(stranger, 12), horizontal_sd_after(stranger, 12));
}

TEST(Stranger, AHeadOnIsPredictedWhereTheTwoMeet) {
  const auto meeting = predicted_intersection(straight({0, 0, -100}, 0), head_on(), 0);
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->closest_time, 40, 1);
  EXPECT_LT(meeting->begin, 32);  // 610 m before at 60 m/s, and what is not known
  EXPECT_LT(meeting->ratio, 0.05);
}

TEST(Stranger, WhoPassesFarAwayIsNone) {
  Stranger stranger = head_on();
  stranger.p_N.y() = 3000;
  EXPECT_FALSE(predicted_intersection(straight({0, 0, -100}, 0), stranger, 0));
  stranger = head_on();
  stranger.p_N.z() = -600;
  EXPECT_FALSE(predicted_intersection(straight({0, 0, -100}, 0), stranger, 0));
}

// The room is blocked where the intersection is, and moves along.
TEST(Stranger, TheRoomMovesWithIt) {
  const auto meeting = predicted_intersection(straight({0, 0, -100}, 0), head_on(), 0);
  Airspace airspace;
  airspace.movers.push_back(room_of(head_on(), *meeting));
  PathQuery query;
  query.airspace = &airspace;
  const solve::AirspaceMap map(query);
  EXPECT_FALSE(map.is_free(straight({0, 0, -100}, 0)));
  EXPECT_TRUE(map.conflict_at(Vec3(2400 - 40 * 35, 0, -100), 35));
  EXPECT_FALSE(map.conflict_at(Vec3(2400 - 40 * 35, 2000, -100), 35));
}

// Whatever is around the stranger while the two are too near lies in the static room, and
// it is no wider than that.
TEST(Stranger, TheStaticRoomHoldsAllThatTheMovingOneSweeps) {
  Stranger stranger = head_on();
  stranger.v_N = Vec3(-30, 20, 1);
  stranger.p_N = Vec3(2000, -800, -130);
  const auto meeting = predicted_intersection(straight({0, 0, -100}, 0), stranger, 0);
  ASSERT_TRUE(meeting);
  const Zone room = static_room_of(stranger, *meeting);
  for (const double time : {meeting->begin, meeting->closest_time,
                            (meeting->begin + meeting->end) / 2, meeting->end}) {
    const Vec3 place = stranger.p_N + time * stranger.v_N;
    EXPECT_TRUE(covers(room, place.head<2>())) << time;
    EXPECT_LE(room.floor_msl, -place.z() - meeting->kept.vertical + 1e-9);
    EXPECT_GE(room.ceiling_msl, -place.z() + meeting->kept.vertical - 1e-9);
  }
  const Vec2 along = stranger.v_N.head<2>().normalized();
  const double half = (meeting->end - meeting->begin) / 2;
  const Vec2 middle = (stranger.p_N + (meeting->begin + half) * stranger.v_N).head<2>();
  const double b = meeting->kept.horizontal;
  const double a = b + half * stranger.v_N.head<2>().norm();
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(covers(room, middle + side * 0.999 * a * along));
    EXPECT_FALSE(covers(room, middle + side * 1.02 * a * along));
    const Vec2 across = geo::turned_right(along);
    EXPECT_TRUE(covers(room, middle + side * 0.999 * b * across));
    EXPECT_FALSE(covers(room, middle + side * 1.02 * b * across));
  }
  EXPECT_EQ(room.from, meeting->begin - 5);
  EXPECT_EQ(room.until, meeting->end + 5);
}

// The flight around keeps out of the room of the kind that is asked for.
TEST(Stranger, TheFlightAroundKeepsOutOfTheRoomThatIsChosen) {
  const FlightPlan plan = straight({0, 0, -100}, 0);
  std::vector<Stranger> strangers = {head_on()};
  strangers[0].p_N.x() = 3400;
  PathQuery query;
  const auto flight = [&](StrangerRoom kind) {
    const StrangerView view{
        0, Vec3(0, 0, -100), Vec3(20, 0, 0), plan, 200, strangers, query, {}, {}, kind};
    return flight_around(view, *predicted_intersection(plan, strangers[0], 0), 2);
  };
  const auto standing = flight(StrangerRoom::kStatic);
  ASSERT_TRUE(standing);
  Airspace airspace;
  airspace.zones = {
      static_room_of(strangers[0], *predicted_intersection(plan, strangers[0], 0))};
  query.airspace = &airspace;
  const solve::AirspaceMap map(query);
  EXPECT_TRUE(map.is_free(*standing));
  // Of one that crosses slowly from the right the moving room leaves more way.
  strangers[0].p_N = Vec3(1100, 1000, -100);
  strangers[0].v_N = Vec3(0, -18, 0);
  const auto behind = flight(StrangerRoom::kMoving);
  const auto beside = flight(StrangerRoom::kStatic);
  ASSERT_TRUE(behind);
  ASSERT_TRUE(beside);
  EXPECT_GT(model::end_time_of(*beside), model::end_time_of(*behind) + 1);
}

}  // namespace
}  // namespace skein::reasoning::stranger_test
