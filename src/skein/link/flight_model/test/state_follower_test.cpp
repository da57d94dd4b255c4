// SPDX-License-Identifier: Apache-2.0
#include "skein/link/flight_model/state_follower.h"

#include <gtest/gtest.h>

namespace skein::flight_model::state_follower_test {
namespace {

geo::LocalFrame follower_frame() {
  return geo::LocalFrame::at({36.989, -122.0514, 0}).value();
}

// North at 50 m/s, at `time` of the program's clock.
FlightState northward(double time) {
  FlightState state;
  state.time = time;
  state.place = follower_frame().from_plane({50 * time, 0});
  state.place.height_m = 300;
  state.v_N = {50, 0, 0};
  return state;
}

template <class T>
std::vector<T> all_of(const std::vector<VehicleReport>& reports) {
  std::vector<T> found;
  for (const VehicleReport& report : reports)
    if (const auto* one = std::get_if<T>(&report)) found.push_back(*one);
  return found;
}

Time s(double seconds) {
  return Time::from_seconds(seconds);
}

TEST(StateFollower, SaysHowItMovesInTheLocalFrame) {
  StateFollower follower(follower_frame());
  std::vector<VehicleReport> out;
  FlightState state = northward(10);
  state.wind_N = {-5, 0, 0};
  state.on_ground = true;
  state.fuel = 0.5;
  follower.take(state, s(100), out);
  const auto motion = all_of<VehicleMotion>(out);
  ASSERT_EQ(motion.size(), 1U);
  EXPECT_LT((motion[0].p_N - Vec3(500, 0, -300)).norm(), 1e-6);
  EXPECT_EQ(motion[0].time, s(100));
  EXPECT_NEAR(motion[0].airspeed, 55, 1e-12);
  EXPECT_EQ(motion[0].wind_N, Vec2(-5, 0));
  const auto condition = all_of<VehicleCondition>(out);
  ASSERT_EQ(condition.size(), 1U);
  EXPECT_TRUE(condition[0].on_ground);
  EXPECT_EQ(condition[0].charge, 0.5);
}

// Frames of a simulator come in by jerks; what it says is even.
TEST(StateFollower, TimesAreAsFarApartAsTheProgramHasThem) {
  StateFollower follower(follower_frame());
  std::vector<VehicleReport> out;
  for (int k = 0; k < 400; ++k)
    follower.take(northward(10 + 0.02 * k), s(100 + 0.02 * k + 0.003 * (k % 3)), out);
  const auto motion = all_of<VehicleMotion>(out);
  ASSERT_EQ(motion.size(), 400U);
  for (std::size_t k = 300; k < motion.size(); ++k) {
    EXPECT_NEAR((motion[k].time - motion[k - 1].time).seconds(), 0.02, 2e-4);
    // The mean of the jerks, 3 ms, stays in it.
    EXPECT_NEAR(motion[k].time.seconds(), 100.003 + 0.02 * static_cast<double>(k), 1e-3);
  }
  EXPECT_EQ(all_of<VehicleCondition>(out).size(), 1U) << "nothing has changed";
  EXPECT_TRUE(all_of<LinkChange>(out).empty());
}

TEST(StateFollower, APauseIsNoNewsAndNoReset) {
  StateFollower follower(follower_frame());
  std::vector<VehicleReport> out;
  follower.take(northward(10), s(100), out);
  follower.take(northward(10), s(101), out);
  EXPECT_EQ(all_of<VehicleMotion>(out).size(), 1U);
  follower.take(northward(10.1), s(130), out);
  const auto motion = all_of<VehicleMotion>(out);
  ASSERT_EQ(motion.size(), 2U);
  EXPECT_EQ(motion[1].time, s(130));
  EXPECT_TRUE(all_of<LinkChange>(out).empty());
}

TEST(StateFollower, AClockThatGoesBackIsAReset) {
  StateFollower follower(follower_frame());
  std::vector<VehicleReport> out;
  follower.take(northward(10), s(100), out);
  out.clear();
  follower.take(northward(1), s(100.02), out);
  ASSERT_GE(out.size(), 2U);
  const auto* change = std::get_if<LinkChange>(&out[0]);
  ASSERT_TRUE(change) << "before the motion";
  EXPECT_EQ(change->kind, LinkChange::Kind::kRebooted);
  EXPECT_NE(change->text.find("clock"), std::string::npos);
  EXPECT_EQ(all_of<VehicleMotion>(out)[0].time, s(100.02));
}

TEST(StateFollower, AJumpIsAResetAndAFastTurnIsNone) {
  StateFollower follower(follower_frame());
  std::vector<VehicleReport> out;
  follower.take(northward(10), s(100), out);
  FlightState next = northward(10.1);
  next.v_N = {0, 50, 0};  // 0.1 s of 500 m/s^2 would be too much, of 50 m not
  follower.take(next, s(100.1), out);
  EXPECT_TRUE(all_of<LinkChange>(out).empty());
  next = northward(10.2);
  next.place = follower_frame().from_plane({510, 400});
  next.place.height_m = 300;
  follower.take(next, s(100.2), out);
  const auto changes = all_of<LinkChange>(out);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_NE(changes[0].text.find("398 m"), std::string::npos) << changes[0].text;
}

}  // namespace
}  // namespace skein::flight_model::state_follower_test
