#include "skein/layer/reasoning/avoidance/strangers/stranger.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/reasoning/planning/search/airspace_map.h"

namespace skein::reasoning {
namespace {

FlightPlan north() {
  FlightElement e;
  e.duration = 200;
  e.airspeed = 20;
  e.p_N = Vec3(0, 0, -100);
  return {e};
}

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
  const auto meeting = predicted_intersection(north(), head_on(), 0);
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->closest_time, 40, 1);
  EXPECT_LT(meeting->begin, 32);  // 610 m before at 60 m/s, and what is not known
  EXPECT_LT(meeting->ratio, 0.05);
}

TEST(Stranger, WhoPassesFarAwayIsNone) {
  Stranger stranger = head_on();
  stranger.p_N.y() = 3000;
  EXPECT_FALSE(predicted_intersection(north(), stranger, 0));
  stranger = head_on();
  stranger.p_N.z() = -600;
  EXPECT_FALSE(predicted_intersection(north(), stranger, 0));
}

// The room is blocked where the intersection is, and moves along.
TEST(Stranger, TheRoomMovesWithIt) {
  const auto meeting = predicted_intersection(north(), head_on(), 0);
  Airspace airspace;
  airspace.movers.push_back(room_of(head_on(), *meeting));
  PathQuery query;
  query.airspace = &airspace;
  const planning::AirspaceMap map(query);
  EXPECT_FALSE(map.is_free(north()));
  EXPECT_TRUE(map.conflict_at(Vec3(2400 - 40 * 35, 0, -100), 35));
  EXPECT_FALSE(map.conflict_at(Vec3(2400 - 40 * 35, 2000, -100), 35));
}

}  // namespace
}  // namespace skein::reasoning
