// SPDX-License-Identifier: Apache-2.0
#include "skein/link/flight_model/x_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "skein/link/flight_model/test/x_plane_packets.h"

namespace skein::flight_model::x_plane_test {
namespace {

std::optional<FlightState> take(XPlaneReader& reader, const std::string& datagram) {
  return reader.read(std::as_bytes(std::span(datagram)));
}

// Numbers of the datarefs as they are asked for.
constexpr std::int32_t kTime = 0, kPaused = 1, kGround = 2, kX = 3, kY = 4, kZ = 5;

XPlanePosition over_the_bay() {
  XPlanePosition at;
  at.longitude_deg = -122.05140001;
  at.latitude_deg = 36.98900001;
  at.msl_m = 300.5;
  at.pitch_deg = 4;
  at.heading_deg = 90;
  at.roll_deg = -20;
  at.east_mps = 50;
  at.up_mps = 2;
  at.south_mps = -3;
  at.p = 0.125F;
  at.q = 0.25F;
  at.r = -0.5F;
  return at;
}

TEST(XPlane, PutsAStateTogether) {
  XPlaneReader reader;
  EXPECT_FALSE(take(reader, rpos(over_the_bay()))) << "its time is not known yet";
  EXPECT_FALSE(take(reader, rref({{kTime, 7.5F}, {kGround, 0}})));
  EXPECT_FALSE(take(reader, rref({{kX, 4}, {kY, 0}, {kZ, 1}})));
  const auto state = take(reader, rpos(over_the_bay()));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->time, 7.5);
  EXPECT_EQ(state->place.longitude_deg, -122.05140001) << "in double precision";
  EXPECT_EQ(state->place.latitude_deg, 36.98900001);
  EXPECT_EQ(state->place.height_m, 300.5);
  EXPECT_LT((state->v_N - Vec3(3, 50, -2)).norm(), 1e-6);
  EXPECT_EQ(state->w_NB_B, Vec3(0.125, 0.25, -0.5));
  const geo::Euler attitude = geo::to_euler(state->q_NB);
  EXPECT_NEAR(geo::degrees(attitude.pitch), 4, 1e-5);
  EXPECT_NEAR(geo::degrees(attitude.roll), -20, 1e-5);
  EXPECT_NEAR(geo::degrees(attitude.yaw), 90, 1e-5);
  EXPECT_LT((state->wind_N - Vec3(-1, 4, 0)).norm(), 1e-6) << "its axes: east, up, south";
  EXPECT_FALSE(state->on_ground);
  EXPECT_EQ(reader.counts().states, 1U);
}

TEST(XPlane, SaysNothingWhileItIsPaused) {
  XPlaneReader reader;
  take(reader, rref({{kTime, 1}, {kGround, 1}, {kPaused, 1}}));
  EXPECT_FALSE(take(reader, rpos(over_the_bay())));
  take(reader, rref({{kPaused, 0}}));
  const auto state = take(reader, rpos(over_the_bay()));
  ASSERT_TRUE(state);
  EXPECT_TRUE(state->on_ground);
}

TEST(XPlane, PassesOverWhatIsBroken) {
  XPlaneReader reader;
  take(reader, rref({{kTime, 1}, {kGround, 0}}));
  take(reader,
       rref({{kTime, std::numeric_limits<float>::quiet_NaN()}, {-1, 3}, {99, 3}}));
  XPlanePosition at = over_the_bay();
  EXPECT_TRUE(take(reader, rpos(at))) << "numbers that are not asked for change nothing";
  at.latitude_deg = 100;
  EXPECT_FALSE(take(reader, rpos(at)));
  at = over_the_bay();
  at.pitch_deg = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(take(reader, rpos(at)));
  EXPECT_FALSE(take(reader, rpos(over_the_bay()).substr(0, 68)));
  EXPECT_FALSE(take(reader, rref({{kTime, 2}}).substr(0, 9)));
  EXPECT_FALSE(take(reader, "DATA*"));
  EXPECT_FALSE(take(reader, ""));
  EXPECT_EQ(reader.counts().passed_over, 6U);
}

TEST(XPlane, AsksForPositionAndDatarefs) {
  const auto requests = x_plane_requests();
  ASSERT_GT(requests.size(), 3U);
  EXPECT_EQ(requests[0], std::string("RPOS\0"
                                     "50\0",
                                     8));
  for (std::size_t k = 1; k < requests.size(); ++k) {
    ASSERT_EQ(requests[k].size(), 413U);
    EXPECT_EQ(requests[k].substr(0, 5), std::string("RREF\0", 5));
    std::int32_t rate = 0, number = -1;
    std::memcpy(&rate, requests[k].data() + 5, 4);
    std::memcpy(&number, requests[k].data() + 9, 4);
    EXPECT_EQ(rate, 50);
    EXPECT_EQ(number, static_cast<std::int32_t>(k - 1));
    EXPECT_EQ(requests[k].substr(13, 4), "sim/");
  }
  EXPECT_STREQ(requests[1].data() + 13, "sim/time/total_flight_time_sec");
}

// The value that a datagram sets, by its dataref.
std::optional<float> setting_of(const std::vector<std::string>& all, const char* name) {
  for (const std::string& each : all) {
    EXPECT_EQ(each.size(), 509U);
    EXPECT_EQ(each.substr(0, 5), std::string("DREF\0", 5));
    if (std::strcmp(each.data() + 9, name) != 0) continue;
    float value = 0;
    std::memcpy(&value, each.data() + 5, 4);
    return value;
  }
  return std::nullopt;
}

TEST(XPlane, SetsControlsAndTakesTheJoystickAtTheBegin) {
  FlightControls controls;
  controls.aileron = 0.5;
  controls.elevator = -0.25;
  controls.rudder = 1;
  controls.throttle = 0.75;
  const auto begin = x_plane_controls(controls, true);
  EXPECT_EQ(setting_of(begin, "sim/operation/override/override_joystick"), 1.0F);
  EXPECT_EQ(setting_of(begin, "sim/joystick/yoke_roll_ratio"), 0.5F);
  EXPECT_EQ(setting_of(begin, "sim/joystick/yoke_pitch_ratio"), -0.25F);
  EXPECT_EQ(setting_of(begin, "sim/joystick/yoke_heading_ratio"), 1.0F);
  EXPECT_EQ(setting_of(begin, "sim/cockpit2/engine/actuators/throttle_ratio_all"), 0.75F);
  const auto later = x_plane_controls(controls, false);
  EXPECT_EQ(setting_of(later, "sim/operation/override/override_joystick"), std::nullopt);
  EXPECT_EQ(setting_of(later, "sim/joystick/yoke_roll_ratio"), 0.5F);
}

}  // namespace
}  // namespace skein::flight_model::x_plane_test
