// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/ardupilot_backend.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "skein/link/physics/test/servo_datagram.h"
#include "skein/link/physics/test/sitl_reader.h"

namespace skein::physics::ardupilot_backend_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// SITL's side: a socket that sends to a backend and hears its answers.
class Sitl {
 public:
  explicit Sitl(const ArduPilotBackend& backend) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(backend.port());
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  }
  Sitl(const Sitl&) = delete;
  Sitl& operator=(const Sitl&) = delete;
  ~Sitl() { ::close(socket_); }

  void send(const std::string& datagram) const {
    EXPECT_EQ(::send(socket_, datagram.data(), datagram.size(), 0),
              static_cast<ssize_t>(datagram.size()));
  }
  void send_frame(std::uint32_t count) const { send(servo_datagram(count)); }

  // The time of the answer [s]; -1 without one.
  double answer(std::chrono::milliseconds patience) {
    pollfd ready{socket_, POLLIN, 0};
    if (::poll(&ready, 1, static_cast<int>(patience.count())) <= 0) return -1;
    char text[4096];
    const ssize_t got = ::recv(socket_, text, sizeof text, 0);
    const auto values =
        reader_.read({text, static_cast<std::size_t>(std::max<ssize_t>(got, 0))});
    return values ? values->at("timestamp")[0] : -2;
  }

 private:
  int socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  SitlReader reader_;
};

ArduPilotBackend opened() {
  auto backend = ArduPilotBackend::open(0);
  EXPECT_TRUE(backend.ok()) << backend.error().text();
  return std::move(backend).value();
}

PhysicsFrame frame_at(double seconds) {
  PhysicsFrame frame;
  frame.time = Time::from_seconds(seconds);
  return frame;
}

TEST(ArduPilotBackend, MovesStepByStep) {
  ArduPilotBackend backend = opened();
  Sitl sitl(backend);
  for (std::uint32_t count = 0; count < 50; ++count) {
    sitl.send(servo_datagram(count, count % 2 ? 16 : 32,
                             static_cast<std::uint16_t>(1000 + count)));
    const auto servos = backend.wait(10s);
    ASSERT_TRUE(servos);
    EXPECT_EQ(servos->frame_count, count);
    EXPECT_EQ(servos->pwm_us[3], 1003 + count);
    ASSERT_TRUE(backend.reply(frame_at(0.0025 * (count + 1))).ok());
    EXPECT_EQ(sitl.answer(10s), Time::from_seconds(0.0025 * (count + 1)).seconds());
  }
  EXPECT_EQ(backend.counts().steps, 50U);
  EXPECT_EQ(backend.counts().restarts + backend.counts().missed +
                backend.counts().ignored + backend.counts().repeats,
            0U);
}

TEST(ArduPilotBackend, AnswersARepeatedFrameByItself) {
  ArduPilotBackend backend = opened();
  Sitl sitl(backend);
  sitl.send_frame(7);
  ASSERT_TRUE(backend.wait(10s));
  ASSERT_TRUE(backend.reply(frame_at(1)).ok());
  EXPECT_EQ(sitl.answer(10s), 1);
  // SITL has not got it.
  std::this_thread::sleep_for(600ms);
  sitl.send_frame(7);
  EXPECT_FALSE(backend.wait(20ms));
  EXPECT_EQ(sitl.answer(10s), 1);
  EXPECT_EQ(backend.counts().repeats, 1U);
  EXPECT_EQ(backend.counts().steps, 1U);
}

TEST(ArduPilotBackend, DoesNotAnswerTwiceWhatHasCrossedItsAnswer) {
  ArduPilotBackend backend = opened();
  Sitl sitl(backend);
  sitl.send_frame(7);
  ASSERT_TRUE(backend.wait(10s));
  sitl.send_frame(7);  // SITL's patience ends while the world still computes
  sitl.send_frame(7);
  ASSERT_TRUE(backend.reply(frame_at(1)).ok());
  EXPECT_FALSE(backend.wait(20ms));
  sitl.send_frame(8);
  ASSERT_TRUE(backend.wait(10s));
  ASSERT_TRUE(backend.reply(frame_at(2)).ok());
  EXPECT_EQ(sitl.answer(10s), 1);
  EXPECT_EQ(sitl.answer(10s), 2);
  EXPECT_EQ(sitl.answer(20ms), -1);
  EXPECT_EQ(backend.counts().repeats, 0U);
}

TEST(ArduPilotBackend, TakesTheNewestOfSeveralFrames) {
  ArduPilotBackend backend = opened();
  Sitl sitl(backend);
  sitl.send_frame(1);
  ASSERT_TRUE(backend.wait(10s));
  ASSERT_TRUE(backend.reply(frame_at(1)).ok());
  EXPECT_EQ(sitl.answer(10s), 1);
  // It comes back from a long pause of the world.
  std::this_thread::sleep_for(600ms);
  sitl.send_frame(1);
  sitl.send_frame(2);
  sitl.send_frame(2);
  const auto servos = backend.wait(10s);
  ASSERT_TRUE(servos);
  EXPECT_EQ(servos->frame_count, 2U);
  EXPECT_EQ(sitl.answer(20ms), -1);
}

TEST(ArduPilotBackend, LetsTheWorldGoOnAndComesBack) {
  ArduPilotBackend backend = opened();
  Sitl sitl(backend);
  const Clock::time_point before = Clock::now();
  EXPECT_FALSE(backend.wait(0ms));
  EXPECT_FALSE(backend.wait(30ms));
  EXPECT_GE(Clock::now() - before, 30ms);
  sitl.send_frame(1);
  ASSERT_TRUE(backend.wait(10s));
  EXPECT_FALSE(backend.wait(10ms));  // without an answer to the frame
  EXPECT_FALSE(backend.wait(10ms));
  sitl.send_frame(1);
  const auto again = backend.wait(10s);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->frame_count, 1U);
  ASSERT_TRUE(backend.reply(frame_at(3)).ok());
  EXPECT_EQ(sitl.answer(10s), 3);
  sitl.send_frame(2);
  EXPECT_TRUE(backend.wait(10s));
}

TEST(ArduPilotBackend, FollowsAProgramThatStartsAgain) {
  ArduPilotBackend backend = opened();
  Sitl first(backend);
  for (const std::uint32_t count : {100U, 101U, 105U, 0U, 1U}) {
    first.send_frame(count);
    ASSERT_TRUE(backend.wait(10s)) << count;
    ASSERT_TRUE(backend.reply(frame_at(count)).ok());
    EXPECT_EQ(first.answer(10s), count);
  }
  EXPECT_EQ(backend.counts().restarts, 1U);
  EXPECT_EQ(backend.counts().missed, 3U);

  // A new process sends from another port, at first with the same count.
  Sitl second(backend);
  const Clock::time_point before = Clock::now();
  std::optional<ServoFrame> servos;
  while (!servos && Clock::now() - before < 10s) {
    second.send_frame(1);
    servos = backend.wait(200ms);
  }
  ASSERT_TRUE(servos);
  EXPECT_GE(Clock::now() - before, 1400ms);
  EXPECT_EQ(backend.counts().restarts, 2U);
  ASSERT_TRUE(backend.reply(frame_at(9)).ok());
  EXPECT_EQ(second.answer(10s), 9);
  EXPECT_EQ(first.answer(0ms), -1);
  EXPECT_EQ(backend.counts().missed, 3U);
}

TEST(ArduPilotBackend, FollowsTheNextProgramAtOnceWhenToldThatOneHasEnded) {
  ArduPilotBackend backend = opened();
  {
    const Sitl first(backend);
    first.send_frame(0);
    ASSERT_TRUE(backend.wait(10s));
    ASSERT_TRUE(backend.reply(frame_at(1)).ok());
    first.send_frame(1);  // its last words
  }
  backend.forget_program();
  EXPECT_FALSE(backend.wait(0ms));
  Sitl second(backend);
  second.send_frame(0);
  const Clock::time_point before = Clock::now();
  const auto servos = backend.wait(10s);
  ASSERT_TRUE(servos);
  EXPECT_EQ(servos->frame_count, 0U);
  EXPECT_LT(Clock::now() - before, 1s);
  EXPECT_EQ(backend.counts().restarts, 1U);
  EXPECT_EQ(backend.counts().ignored, 0U);
  backend.forget_program();
  EXPECT_THROW(std::ignore = backend.reply(frame_at(2)), Bug);
}

TEST(ArduPilotBackend, KeepsToOneOfTwoPrograms) {
  ArduPilotBackend backend = opened();
  Sitl one(backend), other(backend);
  for (std::uint32_t count = 1; count <= 20; ++count) {
    one.send_frame(count);
    other.send_frame(20 - count);
    const auto servos = backend.wait(10s);
    ASSERT_TRUE(servos);
    EXPECT_EQ(servos->frame_count, count);
    ASSERT_TRUE(backend.reply(frame_at(count)).ok());
    EXPECT_EQ(one.answer(10s), count);
  }
  EXPECT_EQ(other.answer(20ms), -1);
  EXPECT_EQ(backend.counts().restarts, 0U);
  EXPECT_FALSE(backend.wait(20ms));
  EXPECT_EQ(backend.counts().ignored, 20U);
  EXPECT_NE(backend.counts().last_ignored.find("same instance"), std::string::npos);
}

TEST(ArduPilotBackend, PassesOverWhatIsNoFrame) {
  ArduPilotBackend backend = opened();
  Sitl sitl(backend);
  sitl.send("");
  sitl.send("garbage");
  sitl.send(std::string(60'000, '\x48'));
  std::string foreign = servo_datagram(3);
  foreign[1] = 0;
  sitl.send(foreign);
  sitl.send(servo_datagram(3).substr(0, 39));
  EXPECT_FALSE(backend.wait(20ms));
  EXPECT_EQ(backend.counts().ignored, 5U);
  EXPECT_EQ(backend.counts().last_ignored,
            "a datagram of 16 channels has 40 bytes, not 39.");
  sitl.send("garbage");
  sitl.send_frame(4);
  sitl.send("garbage");
  const auto servos = backend.wait(10s);
  ASSERT_TRUE(servos);
  EXPECT_EQ(servos->frame_count, 4U);
  EXPECT_EQ(backend.counts().ignored, 7U);
}

TEST(ArduPilotBackend, ReturnsInTimeUnderAFlood) {
  ArduPilotBackend backend = opened();
  std::atomic<bool> stop = false;
  std::thread flood([&] {
    const Sitl sitl(backend);
    while (!stop) sitl.send("garbage");
  });
  const Clock::time_point before = Clock::now();
  EXPECT_FALSE(backend.wait(100ms));
  EXPECT_LT(Clock::now() - before, 5s);
  stop = true;
  flood.join();
  EXPECT_GT(backend.counts().ignored, 0U);
}

TEST(ArduPilotBackend, KeepsAFrameUnansweredThatCannotBe) {
  ArduPilotBackend backend = opened();
  Sitl sitl(backend);
  EXPECT_THROW(std::ignore = backend.reply(frame_at(1)), Bug);  // nobody has asked
  sitl.send_frame(1);
  ASSERT_TRUE(backend.wait(10s));
  PhysicsFrame bad = frame_at(1);
  bad.airspeed = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(backend.reply(bad).ok());
  EXPECT_EQ(sitl.answer(20ms), -1);
  EXPECT_TRUE(backend.reply(frame_at(1)).ok());
  EXPECT_EQ(sitl.answer(10s), 1);
  EXPECT_THROW(std::ignore = backend.reply(frame_at(2)), Bug);  // it has its answer
}

TEST(ArduPilotBackend, SaysWhereItCannotWait) {
  const ArduPilotBackend backend = opened();
  const auto taken = ArduPilotBackend::open(backend.port());
  ASSERT_FALSE(taken.ok());
  EXPECT_EQ(taken.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(taken.error().text().find("in use"), std::string::npos);
  const auto nowhere = ArduPilotBackend::open(0, "localhost.");
  ASSERT_FALSE(nowhere.ok());
  EXPECT_EQ(nowhere.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(ardupilot_port(0), 9002);
  EXPECT_EQ(ardupilot_port(3), 9032);
}

// Two aircraft, each in a thread of its own, with programs that lose answers on the way.
TEST(ArduPilotBackend, ServesSeveralProgramsOfOneProcess) {
  constexpr std::uint32_t kSteps = 2000;
  const auto fly = [](ArduPilotBackend& backend, double dt) {
    std::uint32_t steps = 0;
    while (steps < kSteps)
      if (const auto servos = backend.wait(10s)) {
        if (servos->frame_count != steps) break;
        if (!backend.reply(frame_at(dt * ++steps)).ok()) break;
      } else {
        break;
      }
    // What is lost of the last answers is sent again.
    backend.wait(2s);
    return steps;
  };
  const auto follow = [](const ArduPilotBackend& backend, double dt, std::uint32_t lost) {
    Sitl sitl(backend);
    for (std::uint32_t count = 0; count < kSteps; ++count) {
      sitl.send_frame(count);
      double answer = sitl.answer(10s);
      if (count == lost) {
        std::this_thread::sleep_for(1s);
        sitl.send_frame(count);
        answer = sitl.answer(10s);
      }
      if (answer != Time::from_seconds(dt * (count + 1)).seconds()) return count;
    }
    return kSteps;
  };
  ArduPilotBackend a = opened(), b = opened();
  std::uint32_t steps[2] = {}, answers[2] = {};
  std::thread threads[] = {
      std::thread([&] { steps[0] = fly(a, 0.0025); }),
      std::thread([&] { steps[1] = fly(b, 0.01); }),
      std::thread([&] { answers[0] = follow(a, 0.0025, 700); }),
      std::thread([&] { answers[1] = follow(b, 0.01, kSteps - 1); })};
  for (std::thread& thread : threads) thread.join();
  for (const int k : {0, 1}) {
    EXPECT_EQ(steps[k], kSteps);
    EXPECT_EQ(answers[k], kSteps);
  }
  EXPECT_EQ(a.counts().repeats, 1U);
  EXPECT_EQ(b.counts().repeats, 1U);
}

}  // namespace
}  // namespace skein::physics::ardupilot_backend_test
