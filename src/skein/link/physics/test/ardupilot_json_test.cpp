// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/ardupilot_json.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "skein/link/physics/test/servo_datagram.h"
#include "skein/link/physics/test/sitl_reader.h"

namespace skein::physics::ardupilot_json_test {
namespace {

using namespace std::string_literals;

Result<ServoFrame> parse(const std::string& datagram) {
  return parse_servo_frame(std::as_bytes(std::span(datagram)));
}

std::string text_of(const PhysicsFrame& frame) {
  std::string text = "what was here before";
  EXPECT_TRUE(write_json(frame, text).ok());
  return text;
}

TEST(ServoFrames, AreReadWithSixteenAndWithThirtyTwoChannels) {
  for (const std::size_t channels : {16U, 32U}) {
    const auto frame = parse(servo_datagram(0x01020304, channels, 1100, 400));
    ASSERT_TRUE(frame.ok()) << frame.error().text();
    EXPECT_EQ(frame.value().channels, channels);
    EXPECT_EQ(frame.value().frame_rate_hz, 400);
    EXPECT_EQ(frame.value().frame_count, 0x01020304U);
    for (std::size_t k = 0; k < ServoFrame::kMaxChannels; ++k)
      EXPECT_EQ(frame.value().pwm_us[k], k < channels ? 1100 + k : 0);
  }
  // Byte by byte, as the interface has them.
  std::string bytes = "\x1a\x48\xb0\x04\x07\x00\x00\x00"s;
  for (int k = 0; k < 16; ++k) bytes += "\xdc\x05";
  ASSERT_TRUE(parse(bytes).ok());
  EXPECT_EQ(parse(bytes).value().frame_rate_hz, 1200);
  EXPECT_EQ(parse(bytes).value().frame_count, 7U);
  EXPECT_EQ(parse(bytes).value().pwm_us[15], 1500);
}

TEST(ServoFrames, AreNothingElse) {
  const std::string good = servo_datagram(1);
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_FALSE(parse(good.substr(0, length)).ok());
  EXPECT_FALSE(parse(good + '\0').ok());
  EXPECT_FALSE(
      parse(good + servo_datagram(1).substr(8)).ok());  // 32 channels, magic of 16
  std::string foreign = good;
  foreign[0] ^= 1;
  const auto refused = parse(foreign);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message,
            "the magic number 18459 is neither 18458 nor 29569.");
}

TEST(PhysicsFrames, HaveTheFormThatSitlReads) {
  PhysicsFrame frame;
  frame.time = Time::from_ns(12'345'678'901);
  frame.w_NB_B = {0.1, -0.25, 1e-7};
  frame.f_B = {0, 0, -9.80665};
  frame.p_N = {1, 2, -3.5};
  frame.v_N = {20, 0, 0};
  frame.q_NB = Quat(0.5, -0.5, 0.5, 0.5);
  frame.airspeed = 20.5;
  frame.range = 3.25;
  frame.battery = PhysicsBattery{12.6, 8};
  EXPECT_EQ(text_of(frame),
            "\n{\"timestamp\":12.345678901,"
            "\"imu\":{\"gyro\":[0.1,-0.25,1e-07],\"accel_body\":[0,0,-9.80665]},"
            "\"position\":[1,2,-3.5],\"quaternion\":[0.5,-0.5,0.5,0.5],"
            "\"velocity\":[20,0,0],\"rng_1\":3.25,\"airspeed\":20.5,\"no_time_sync\":1,"
            "\"battery\":{\"voltage\":12.6,\"current\":8}}\n");
}

TEST(PhysicsFrames, LeaveOutWhatTheyDoNotHave) {
  PhysicsFrame frame;
  frame.paced_by_sender = false;
  const auto values = SitlReader().read(text_of(frame));
  ASSERT_TRUE(values);
  EXPECT_EQ(values->size(), 7U);
  for (const char* name : {"rng_1", "no_time_sync", "voltage", "attitude"})
    EXPECT_EQ(values->count(name), 0U) << name;
}

TEST(PhysicsFrames, AreReadBySitlFromTheFirstDatagramOn) {
  SitlReader sitl;
  PhysicsFrame frame;
  for (const double time : {0.0025, 0.005, 0.0075}) {
    frame.time = Time::from_seconds(time);
    const auto values = sitl.read(text_of(frame));
    ASSERT_TRUE(values);
    EXPECT_EQ(values->at("timestamp"), std::vector<double>{time});
  }
}

TEST(PhysicsFrames, SayTimesToTheNanosecond) {
  PhysicsFrame frame;
  for (const auto& [ns, text] :
       std::map<std::int64_t, std::string>{{0, "0.000000000"},
                                           {1, "0.000000001"},
                                           {-1, "-0.000000001"},
                                           {-2'500'000'000, "-2.500000000"},
                                           {86'400'000'000'001, "86400.000000001"}}) {
    frame.time = Time::from_ns(ns);
    EXPECT_NE(text_of(frame).find("{\"timestamp\":" + text + ","), std::string::npos)
        << text_of(frame);
  }
}

TEST(PhysicsFrames, GiveEveryNumberBackExactly) {
  EXPECT_TRUE(rc::check([] {
    const auto number = [] {
      const double any = *rc::gen::arbitrary<double>();
      return std::isfinite(any) ? any : 0.0;
    };
    const auto vector = [&] { return Vec3(number(), number(), number()); };
    const auto list = [](const Vec3& v) {
      return std::vector<double>{v.x(), v.y(), v.z()};
    };
    PhysicsFrame frame;
    frame.time = Time::from_ns(*rc::gen::inRange<std::int64_t>(0, 1'000'000'000'000));
    frame.w_NB_B = vector();
    frame.f_B = vector();
    frame.p_N = vector();
    frame.v_N = vector();
    frame.q_NB = Quat(number(), number(), number(), number());
    frame.airspeed = number();
    if (*rc::gen::arbitrary<bool>()) frame.range = number();
    if (*rc::gen::arbitrary<bool>()) frame.battery = PhysicsBattery{number(), number()};
    const auto values = SitlReader().read(text_of(frame));
    RC_ASSERT(values.has_value());
    RC_ASSERT(values->at("timestamp")[0] == frame.time.seconds());
    RC_ASSERT(values->at("gyro") == list(frame.w_NB_B));
    RC_ASSERT(values->at("accel_body") == list(frame.f_B));
    RC_ASSERT(values->at("position") == list(frame.p_N));
    RC_ASSERT(values->at("velocity") == list(frame.v_N));
    RC_ASSERT(values->at("quaternion") ==
              (std::vector<double>{frame.q_NB.w(), frame.q_NB.x(), frame.q_NB.y(),
                                   frame.q_NB.z()}));
    RC_ASSERT(values->at("airspeed")[0] == frame.airspeed);
    RC_ASSERT(values->count("rng_1") == frame.range.has_value());
    if (frame.range) RC_ASSERT(values->at("rng_1")[0] == *frame.range);
    if (frame.battery) RC_ASSERT(values->at("current")[0] == frame.battery->current);
  }));
}

TEST(PhysicsFrames, HoldFiniteNumbersOnly) {
  std::string text;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    PhysicsFrame frame;
    frame.v_N.y() = bad;
    const auto refused = write_json(frame, text);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().text(), "velocity: a number is not finite.");
    frame = {};
    frame.range = bad;
    EXPECT_FALSE(write_json(frame, text).ok());
  }
}

TEST(ServoFollower, TellsStepsRepeatsAndRestartsApart) {
  ServoFollower follower;
  EXPECT_EQ(follower.take(5), ServoStep::kBegin);
  EXPECT_EQ(follower.take(6), ServoStep::kNext);
  EXPECT_EQ(follower.take(6), ServoStep::kRepeat);
  EXPECT_EQ(follower.take(7), ServoStep::kNext);
  EXPECT_EQ(follower.missed(), 0U);
  EXPECT_EQ(follower.take(10), ServoStep::kNext);
  EXPECT_EQ(follower.missed(), 2U);
  EXPECT_EQ(follower.take(9), ServoStep::kBegin);
  EXPECT_EQ(follower.take(0), ServoStep::kBegin);
  EXPECT_EQ(follower.take(0), ServoStep::kRepeat);
  EXPECT_EQ(follower.take(1), ServoStep::kNext);
  EXPECT_EQ(follower.missed(), 2U);
}

TEST(ServoFollower, GoesOnWhenTheCountGoesRound) {
  ServoFollower follower;
  follower.take(0xffff'fffeU);
  EXPECT_EQ(follower.take(0xffff'ffffU), ServoStep::kNext);
  EXPECT_EQ(follower.take(0), ServoStep::kNext);
  EXPECT_EQ(follower.take(1), ServoStep::kNext);
  EXPECT_EQ(follower.missed(), 0U);
}

}  // namespace
}  // namespace skein::physics::ardupilot_json_test
