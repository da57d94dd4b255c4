// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/hil_session.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace skein::physics::hil_session_test {
namespace {

// A session, what it sends, and frames of an autopilot to give to it.
struct SessionBench {
  template <mavlink::Message T>
  void give(const T& message) {
    session.received(autopilot.write(message));
  }
  template <mavlink::Message T>
  std::vector<T> sent() const {
    std::vector<T> all;
    for (const auto& [id, payload] : out)
      if (id == mavlink::kFacts<T>.id) all.push_back(mavlink::unpack<T>(payload));
    return all;
  }
  void ask_for(std::uint16_t command, float param1, float param2,
               std::uint8_t system = 0) {
    mavlink::CommandLong m;
    m.command = command;
    m.param1 = param1;
    m.param2 = param2;
    m.target_system = system;
    give(m);
  }
  // Moves on in steps of 4 ms; how often the truth went out.
  std::size_t truths(int steps) {
    const std::size_t before = sent<mavlink::HilStateQuaternion>().size();
    for (int k = 0; k < steps; ++k) {
      truth.time += Time::from_ns(4'000'000);
      session.send(truth);
    }
    return sent<mavlink::HilStateQuaternion>().size() - before;
  }

  std::vector<std::pair<std::uint32_t, std::vector<std::byte>>> out;
  mavlink::FrameParser parser;
  HilSession session{1, 200, [this](std::span<const std::byte> bytes) {
                       parser.read(bytes, [this](const mavlink::Frame& frame) {
                         EXPECT_EQ(frame.system(), 1);
                         EXPECT_EQ(frame.component(), 200);
                         const auto payload = frame.payload();
                         out.emplace_back(frame.id(),
                                          std::vector(payload.begin(), payload.end()));
                       });
                     }};
  mavlink::FrameWriter autopilot{7, 1};
  HilTruth truth;
};

TEST(HilSession, TakesTheNewestControlsOnce) {
  SessionBench bench;
  EXPECT_FALSE(bench.session.take_controls());
  mavlink::HilActuatorControls m;
  m.controls[2] = 0.25F;
  bench.give(m);
  m.controls[2] = 0.5F;
  bench.give(m);
  const auto controls = bench.session.take_controls();
  ASSERT_TRUE(controls);
  EXPECT_EQ(controls->channel[2], 0.5);
  EXPECT_FALSE(bench.session.take_controls());
}

TEST(HilSession, SendsMessagesThatCanBeReadAgain) {
  SessionBench bench;
  HilSensors sensors;
  sensors.time = Time::from_seconds(1);
  sensors.imu = HilImu{{0, 0, -9.75}, Vec3::Zero()};
  bench.session.send(sensors);
  HilFix fix;
  fix.satellites = 9;
  bench.session.send(fix);
  bench.session.send_heartbeat();
  EXPECT_EQ(bench.sent<mavlink::HilSensor>().at(0).zacc, -9.75F);
  EXPECT_EQ(bench.sent<mavlink::HilGps>().at(0).satellites_visible, 9);
  const auto heartbeat = bench.sent<mavlink::Heartbeat>().at(0);
  EXPECT_EQ(heartbeat.autopilot, 8);  // it is none
  EXPECT_EQ(heartbeat.mavlink_version, 3);
}

TEST(HilSession, SendsTheTruthAsOftenAsItWasAskedFor) {
  SessionBench bench;
  EXPECT_EQ(bench.truths(100), 0U);  // by itself never
  bench.ask_for(511, 115, 5000);
  const auto ack = bench.sent<mavlink::CommandAck>().at(0);
  EXPECT_EQ(ack.command, 511);
  EXPECT_EQ(ack.result, 0);
  EXPECT_EQ(ack.target_system, 7);
  EXPECT_EQ(ack.target_component, 1);
  EXPECT_EQ(bench.truths(1), 1U);
  EXPECT_EQ(bench.truths(1000), 800U);  // 4 s in steps of 4 ms, each 5 ms
  bench.ask_for(511, 115, 1);           // faster than it can be
  EXPECT_EQ(bench.truths(100), 100U);
  bench.ask_for(511, 115, -1);
  EXPECT_EQ(bench.truths(100), 0U);
  bench.ask_for(511, 115, std::numeric_limits<float>::infinity());
  EXPECT_EQ(bench.truths(15'001), 2U);  // each minute
  bench.ask_for(511, 115, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(bench.truths(100), 0U);
  bench.ask_for(511, 115, 0);
  EXPECT_EQ(bench.truths(100), 0U);
}

TEST(HilSession, MakesUpForNoTruthThatWasMissed) {
  SessionBench bench;
  bench.ask_for(511, 115, 5000);
  bench.truths(1);
  bench.truth.time += Time::from_seconds(10);
  EXPECT_LE(bench.truths(10), 9U);
}

TEST(HilSession, RefusesWhatItDoesNotKnow) {
  SessionBench bench;
  bench.ask_for(511, 107, 5000);
  bench.ask_for(400, 1, 0);
  const auto acks = bench.sent<mavlink::CommandAck>();
  ASSERT_EQ(acks.size(), 2U);
  EXPECT_EQ(acks[0].result, 3);
  EXPECT_EQ(acks[1].command, 400);
  EXPECT_EQ(acks[1].result, 3);
  bench.ask_for(511, 115, 5000, 42);  // for another system
  EXPECT_EQ(bench.sent<mavlink::CommandAck>().size(), 2U);
  EXPECT_EQ(bench.truths(10), 0U);
}

TEST(HilSession, HearsWhoseAutopilotItIs) {
  SessionBench bench;
  EXPECT_FALSE(bench.session.autopilot());
  mavlink::Heartbeat m;
  m.autopilot = 12;
  bench.give(m);
  EXPECT_EQ(bench.session.autopilot(), 12);
}

TEST(HilSession, FindsFramesInBytesHoweverTheyAreCut) {
  SessionBench bench;
  const std::vector<std::byte> garbage(100, std::byte{0xfd});
  bench.session.received(garbage);
  const auto frame = bench.autopilot.write(mavlink::HilActuatorControls{});
  for (std::size_t k = 0; k < frame.size(); ++k)
    bench.session.received(frame.subspan(k, 1));
  // What looks like the begin of a frame may hold up to 280 bytes.
  bench.session.received(std::vector<std::byte>(300));
  EXPECT_TRUE(bench.session.take_controls());
  EXPECT_GT(bench.session.counts().skipped_bytes, 0U);
}

}  // namespace
}  // namespace skein::physics::hil_session_test
